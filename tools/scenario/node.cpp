// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tools/scenario/node.hpp"

#include <charconv>
#include <utility>

namespace scarp {

const Node* Node::find(std::string_view name) const {
  if (!is_table()) return nullptr;
  for (const Node& child : children)
    if (child.key == name) return &child;
  return nullptr;
}

Node* Node::find(std::string_view name) { return const_cast<Node*>(std::as_const(*this).find(name)); }

SourceLocation location(const Place& place) {
  return {place.file ? *place.file : std::string(), place.line, place.column, -1};
}

const Node& nearest_node(const Node& root, const std::vector<std::string>& steps) {
  const Node* node = &root;
  for (const std::string& step : steps) {
    const Node* next = node->find(step);
    if (node->is_array()) {
      std::size_t index = node->children.size();
      std::from_chars(step.data(), step.data() + step.size(), index);
      if (index < node->children.size()) next = &node->children[index];
    }
    if (!next) break;
    node = next;
  }
  return *node;
}

void refuse(const Node& node, const std::string& what, const std::string& allowed) {
  throw Error("scenario", what, node.is_table() ? "" : node.written, allowed, location(node.place));
}

std::string shortened(std::string_view text) {
  constexpr std::size_t kMost = 60;
  std::string out;
  bool blank = false;
  for (const char c : text) {
    const bool is_blank = static_cast<unsigned char>(c) <= ' ' || c == 0x7f;
    if (is_blank && blank) continue;
    blank = is_blank;
    out += is_blank ? ' ' : c;
    if (out.size() > kMost) {
      out.resize(kMost - 3);
      while (!out.empty() && (static_cast<unsigned char>(out.back()) & 0xC0) == 0x80) out.pop_back();
      if (!out.empty() && static_cast<unsigned char>(out.back()) >= 0xC0) out.pop_back();
      return out + "...";
    }
  }
  return out;
}

}  // namespace scarp
