// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/overrides.hpp"

#include <charconv>
#include <utility>

#include "tools/scenario/parse_toml.hpp"
#include "tools/scenario/suggest.hpp"

namespace scarp {
namespace {

struct Override {
  std::vector<std::string> steps;
  std::string value;
  Place place;
};

[[noreturn]] void fail(const Override& set, const std::string& what, const std::string& allowed = {}) {
  throw Error("scenario", what, {}, allowed, location(set.place));
}

Override split_argument(const std::string& argument) {
  Override set;
  set.place.file = std::make_shared<const std::string>("--set " + shortened(argument));
  std::string step;
  char quote = 0;
  std::size_t i = 0;
  for (; i < argument.size() && (quote || argument[i] != '='); ++i) {
    const char c = argument[i];
    if (quote ? c == quote : (c == '"' || c == '\'')) {
      quote = quote ? 0 : c;
    } else if (c == '.' && !quote) {
      set.steps.push_back(std::exchange(step, {}));
    } else {
      step += c;
    }
  }
  if (i == argument.size()) fail(set, "an override needs a value", "--set key.path=value");
  while (step.ends_with(' ')) step.pop_back();
  set.steps.push_back(step);
  for (const std::string& part : set.steps)
    if (part.empty()) fail(set, "an override needs a key between the dots", "--set key.path=value");
  if (set.steps.size() > 64) fail(set, "the path has more than 64 parts");
  set.value = argument.substr(i + 1);
  return set;
}

void move_to(Node& node, const Place& place) {
  node.place = node.key_place = place;
  for (Node& child : node.children) move_to(child, place);
}

Node parse_value(const Override& set) {
  check_toml_bounds(set.value, *set.place.file);
  Node value;
  value.kind = Node::Kind::string;
  value.text = set.value;
  value.written = "\"" + shortened(set.value) + "\"";
  try {
    Node root = parse_toml("value = " + set.value, *set.place.file);
    if (root.children.size() == 1 && root.children[0].key == "value") value = std::move(root.children[0]);
  } catch (const Error&) {
    // By design: what is not TOML is a string, so that `--set model=water` needs no quotes within quotes.
  }
  move_to(value, set.place);
  return value;
}

/// The entry of a list that `step` names: by its `name`, which may be a number such as a year, or by index.
Node& item_of(Node& list, const std::string& step, const std::string& path, const Override& set) {
  std::vector<std::string> names;
  for (Node& item : list.children) {
    const Node* name = item.find("name");
    if (!name || !name->is_string()) continue;
    if (name->text == step) return item;
    names.push_back(name->text);
  }
  std::size_t index = 0;
  const auto [end, code] = std::from_chars(step.data(), step.data() + step.size(), index);
  if (code == std::errc() && end == step.data() + step.size()) {
    if (index < list.children.size()) return list.children[index];
    fail(set, path + " has no entry " + step,
         list.children.empty() ? "none: the list is empty" : "0 to " + std::to_string(list.children.size() - 1));
  }
  fail(set, path + " has no entry named \"" + shortened(step) + "\"" + did_you_mean(step, names),
       names.empty() ? "an index, from 0" : quoted_list(names) + ", or an index from 0");
}

}  // namespace

void apply_override(Node& root, const std::string& argument) {
  const Override set = split_argument(argument);
  Node value = parse_value(set);
  Node* node = &root;
  std::string path;
  for (std::size_t i = 0; i < set.steps.size(); ++i) {
    const std::string& step = set.steps[i];
    if (node->is_array()) {
      node = &item_of(*node, step, path, set);
    } else if (node->is_table()) {
      Node* next = node->find(step);
      if (!next) {
        next = &node->children.emplace_back();
        next->key = step;
        next->place = next->key_place = set.place;
      }
      node = next;
    } else {
      fail(set, path + " holds a single value; it has no \"" + shortened(step) + "\"");
    }
    path += (i ? "." : "") + shortened(step);
  }
  value.key = node->key;
  *node = std::move(value);
}

}  // namespace scarp
