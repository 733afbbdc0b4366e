// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_ply_rows.hpp"

#include <algorithm>
#include <array>

#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

constexpr std::array<std::pair<std::string_view, NumberType>, 16> kTypes{{{"char", NumberType::i8},
                                                                          {"int8", NumberType::i8},
                                                                          {"uchar", NumberType::u8},
                                                                          {"uint8", NumberType::u8},
                                                                          {"short", NumberType::i16},
                                                                          {"int16", NumberType::i16},
                                                                          {"ushort", NumberType::u16},
                                                                          {"uint16", NumberType::u16},
                                                                          {"int", NumberType::i32},
                                                                          {"int32", NumberType::i32},
                                                                          {"uint", NumberType::u32},
                                                                          {"uint32", NumberType::u32},
                                                                          {"float", NumberType::f32},
                                                                          {"float32", NumberType::f32},
                                                                          {"double", NumberType::f64},
                                                                          {"float64", NumberType::f64}}};

NumberType type_named(std::string_view name, const BufferedFile& file) {
  for (const auto& [text, type] : kTypes)
    if (text == name) return type;
  throw Error("ingest", "unknown PLY type", shown(name), "char uchar short ushort int uint float double",
              file.at_line());
}

PlyFormat format_named(const std::vector<std::string_view>& words, const BufferedFile& file) {
  if (words.size() == 3 && words[2] == "1.0") {
    if (words[1] == "ascii") return PlyFormat::ascii;
    if (words[1] == "binary_little_endian") return PlyFormat::binary_little_endian;
    if (words[1] == "binary_big_endian") return PlyFormat::binary_big_endian;
  }
  throw Error("ingest", "unknown PLY format", words.size() > 1 ? shown(words[1]) : "nothing",
              "ascii, binary_little_endian or binary_big_endian, 1.0", file.at_line());
}

PlyElement parse_element(const std::vector<std::string_view>& words, const BufferedFile& file) {
  const auto count = words.size() == 3 ? count_of(words[2]) : std::nullopt;
  if (!count)
    throw Error("ingest", "PLY element without a count", words.size() > 2 ? shown(words[2]) : "nothing",
                "element NAME COUNT", file.at_line());
  return {std::string(words[1]), *count, {}};
}

PlyProperty parse_property(const std::vector<std::string_view>& words, const BufferedFile& file) {
  PlyProperty property;
  if (words.size() == 5 && words[1] == "list") {
    property.length_type = type_named(words[2], file);
    if (size_of(*property.length_type) > 4 || *property.length_type == NumberType::f32)
      throw Error("ingest", "length of a PLY list is no integer", shown(words[2]), "an integer type", file.at_line());
  } else if (words.size() != 3) {
    throw Error("ingest", "PLY property that cannot be understood", {},
                "property TYPE NAME, or property list TYPE TYPE NAME", file.at_line());
  }
  property.type = type_named(words[words.size() - 2], file);
  property.name = words.back();
  return property;
}

}  // namespace

std::optional<std::uint64_t> PlyElement::fixed_size() const {
  std::uint64_t bytes = 0;
  for (const PlyProperty& property : properties) {
    if (property.length_type) return {};
    bytes += size_of(property.type);
  }
  return bytes;
}

const PlyElement* PlyHeader::find(std::string_view name) const {
  const auto found = std::find_if(elements.begin(), elements.end(), [&](auto& e) { return e.name == name; });
  return found == elements.end() ? nullptr : &*found;
}

PlyHeader read_ply_header(BufferedFile& file) {
  PlyHeader header;
  std::string_view line;
  if (!file.peek().starts_with("ply") || !file.next_line(line) || trimmed(line) != "ply")
    throw Error("ingest", "not a PLY file", {}, "a first line that reads ply", file.at_line());
  bool has_format = false;
  while (file.next_line(line)) {
    const std::vector<std::string_view> words = split(line, ' ');
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "format") {
      header.format = format_named(words, file);
      has_format = true;
    } else if (words[0] == "element") {
      header.elements.push_back(parse_element(words, file));
    } else if (words[0] == "property" && !header.elements.empty()) {
      header.elements.back().properties.push_back(parse_property(words, file));
    } else if (words[0] == "end_header" && has_format) {
      return header;
    } else {
      throw Error("ingest", "line that does not belong in a PLY header", shown(line),
                  "format first, then elements each with its properties, then end_header", file.at_line());
    }
  }
  throw Error("ingest", "PLY header without end_header", {}, {}, file.at_line());
}

PlyRows::PlyRows(BufferedFile& file, PlyFormat format, const PlyElement& element)
    : file_(file), format_(format), element_(element), fixed_size_(element.fixed_size()) {
  std::uint64_t least = 0;  // bytes of a row: each number of a text has a digit and a separator
  for (const PlyProperty& property : element.properties) {
    lists_ += property.length_type ? 1 : 0;
    least += format == PlyFormat::ascii ? 2 : size_of(property.length_type.value_or(property.type));
  }
  const std::uint64_t bytes = file.bytes_left() + (format == PlyFormat::ascii ? 1 : 0);
  const std::uint64_t most = least > 0 ? bytes / least : 0;
  if (element.count > most)
    throw Error("ingest", "PLY header promises more of element '" + element.name + "' than the file can hold",
                std::to_string(element.count), "at most " + std::to_string(most), file.at_line());
}

void PlyRows::next(PlyRow& row) {
  row.scalars.clear();
  row.lists.resize(lists_);
  format_ == PlyFormat::ascii ? next_ascii(row) : next_binary(row);
}

void PlyRows::check_length(double length, std::uint64_t available, const SourceLocation& where) const {
  if (length >= 0 && length <= static_cast<double>(available)) return;
  throw Error("ingest", "length of a list in PLY element '" + element_.name + "'", shortest(length),
              "0 to " + std::to_string(available) + ", which is what is left", where);
}

void PlyRows::next_ascii(PlyRow& row) {
  std::string_view line;
  do {
    if (!file_.next_line(line))
      throw Error("ingest", "PLY file ends inside element '" + element_.name + "'", {},
                  std::to_string(element_.count) + " lines", file_.at_line());
  } while (is_blank(line));
  read_numbers(line, ' ', file_, tokens_);
  std::size_t used = 0, list = 0;
  const auto token = [&](const PlyProperty& property, NumberType type) {
    if (used == tokens_.size())
      throw Error("ingest", "too few values for PLY element '" + element_.name + "'", std::to_string(used), {},
                  file_.at_line());
    const double value = tokens_[used++];
    const NumberRange range = range_of(type);
    if (!fits(value, range))
      throw Error("ingest", "PLY property '" + property.name + "'", shortest(value),
                  "integers " + shortest(range.least) + " to " + shortest(range.most), file_.at_line());
    return value;
  };
  for (const PlyProperty& property : element_.properties) {
    if (!property.length_type) {
      row.scalars.push_back(token(property, property.type));
      continue;
    }
    const double length = token(property, *property.length_type);
    check_length(length, tokens_.size() - used, file_.at_line());
    std::vector<double>& items = row.lists[list++];
    items.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i) items.push_back(token(property, property.type));
  }
  if (used != tokens_.size())
    throw Error("ingest", "too many values for PLY element '" + element_.name + "'", std::to_string(tokens_.size()),
                std::to_string(used), file_.at_line());
}

void PlyRows::next_binary(PlyRow& row) {
  const bool big_endian = format_ == PlyFormat::binary_big_endian;
  if (fixed_size_) {
    const char* bytes = file_.take(*fixed_size_);
    for (const PlyProperty& property : element_.properties) {
      row.scalars.push_back(load_number(bytes, property.type, big_endian));
      bytes += size_of(property.type);
    }
    return;
  }
  std::size_t list = 0;
  for (const PlyProperty& property : element_.properties) {
    const std::size_t size = size_of(property.type);
    if (!property.length_type) {
      row.scalars.push_back(load_number(file_.take(size), property.type, big_endian));
      continue;
    }
    const double length = load_number(file_.take(size_of(*property.length_type)), *property.length_type, big_endian);
    check_length(length, file_.bytes_left() / size, file_.at_byte());
    const char* bytes = file_.take(static_cast<std::uint64_t>(length) * size);
    std::vector<double>& items = row.lists[list++];
    items.clear();
    for (std::size_t i = 0; i < static_cast<std::size_t>(length); ++i)
      items.push_back(load_number(bytes + i * size, property.type, big_endian));
  }
}

void PlyRows::skip() {
  if (format_ != PlyFormat::ascii && fixed_size_) return file_.skip(element_.count * *fixed_size_);
  PlyRow row;
  for (std::uint64_t i = 0; i < element_.count; ++i) next(row);
}

}  // namespace scarp
