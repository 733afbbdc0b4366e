// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_pcd_header.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "ingest/text_scanner.hpp"

namespace scarp {
namespace {

/// Fields and their counts stay far below; bounds every product of the header's numbers.
constexpr std::uint64_t kMostCells = 1 << 20;

using Words = std::vector<std::string>;

struct Entry {
  Words words;
  SourceLocation where;
};
using Entries = std::map<std::string, Entry, std::less<>>;

Entries collect_entries(BufferedFile& file) {
  static constexpr std::string_view known[] = {"VERSION", "FIELDS", "SIZE",      "TYPE",   "COUNT",
                                               "WIDTH",   "HEIGHT", "VIEWPOINT", "POINTS", "DATA"};
  Entries entries;
  std::string_view line;
  while (file.next_line(line)) {
    if (is_blank(line) || is_comment(line)) continue;
    const auto words = split(line, ' ');
    const std::string key(words[0] == "COLUMNS" ? "FIELDS" : words[0]);
    if (std::find(std::begin(known), std::end(known), key) == std::end(known))
      throw Error("ingest", "word that does not belong in a PCD header", shown(words[0]),
                  "VERSION FIELDS SIZE TYPE COUNT WIDTH HEIGHT VIEWPOINT POINTS DATA", file.at_line());
    entries[key] = {Words(words.begin() + 1, words.end()), file.at_line()};
    if (key == "DATA") return entries;
  }
  throw Error("ingest", "PCD header without DATA", {}, {}, file.at_line());
}

const Entry& entry(const Entries& entries, std::string_view key, const BufferedFile& file) {
  const auto found = entries.find(key);
  if (found == entries.end()) throw Error("ingest", "PCD header without " + std::string(key), {}, {}, file.at_line());
  return found->second;
}

std::uint64_t count_entry(const Entries& entries, std::string_view key, const BufferedFile& file) {
  const Entry& e = entry(entries, key, file);
  const auto count = e.words.size() == 1 ? count_of(e.words[0]) : std::nullopt;
  if (!count)
    throw Error("ingest", "PCD " + std::string(key), e.words.empty() ? "nothing" : shown(e.words[0]),
                "one whole number of at least 0", e.where);
  return *count;
}

NumberType type_of(const std::string& type, const std::string& size, const SourceLocation& where) {
  static const std::map<std::string, NumberType> types{
      {"I1", NumberType::i8},  {"I2", NumberType::i16}, {"I4", NumberType::i32}, {"I8", NumberType::i64},
      {"U1", NumberType::u8},  {"U2", NumberType::u16}, {"U4", NumberType::u32}, {"U8", NumberType::u64},
      {"F4", NumberType::f32}, {"F8", NumberType::f64}};
  const auto found = types.find(type + size);
  if (found == types.end())
    throw Error("ingest", "PCD type and size", shown(type + " " + size), "I or U with 1 2 4 8, F with 4 8", where);
  return found->second;
}

std::vector<PcdField> parse_fields(const Entries& entries, const BufferedFile& file) {
  const Entry& names = entry(entries, "FIELDS", file);
  const Entry& sizes = entry(entries, "SIZE", file);
  const Entry& types = entry(entries, "TYPE", file);
  const std::size_t n = names.words.size();
  const Entry counts = entries.count("COUNT") ? entry(entries, "COUNT", file) : Entry{Words(n, "1"), names.where};
  for (const Entry* e : {&sizes, &types, &counts})
    if (e->words.size() != n)
      throw Error("ingest", "PCD header entry with another length than FIELDS", std::to_string(e->words.size()),
                  std::to_string(n), e->where);
  std::vector<PcdField> fields;
  std::uint64_t cells = 0;
  for (std::size_t f = 0; f < n; ++f) {
    const auto count = count_of(counts.words[f]);
    if (!count || *count == 0 || *count > kMostCells || (cells += *count) > kMostCells)
      throw Error("ingest", "PCD COUNT", shown(counts.words[f]), "1 to 2^20 in all", counts.where);
    PcdField field{names.words[f], type_of(types.words[f], sizes.words[f], types.where), *count};
    const std::string name = lower_case(field.name);
    field.packed_colour = (name == "rgb" || name == "rgba") && field.bytes() == 4 && field.count == 1;
    fields.push_back(field);
  }
  return fields;
}

void check_viewpoint(const Entries& entries) {
  const auto found = entries.find("VIEWPOINT");
  if (found == entries.end()) return;
  const Words& words = found->second.words;
  if (words.size() != 7 || !std::all_of(words.begin(), words.end(), [](auto& w) { return number_of(w).has_value(); }))
    throw Error("ingest", "PCD VIEWPOINT", {}, "seven numbers: position and quaternion", found->second.where);
}

}  // namespace

std::uint64_t PcdHeader::stride() const {
  std::uint64_t bytes = 0;
  for (const PcdField& field : fields) bytes += field.bytes();
  return bytes;
}

std::uint64_t PcdHeader::cells() const {
  std::uint64_t count = 0;
  for (const PcdField& field : fields) count += field.count;
  return count;
}

PcdHeader read_pcd_header(BufferedFile& file) {
  const Entries entries = collect_entries(file);
  PcdHeader header;
  header.fields = parse_fields(entries, file);
  check_viewpoint(entries);
  const std::uint64_t width = count_entry(entries, "WIDTH", file);
  const std::uint64_t height = count_entry(entries, "HEIGHT", file);
  std::uint64_t product;
  const bool overflow = __builtin_mul_overflow(width, height, &product);
  header.points = entries.count("POINTS") ? count_entry(entries, "POINTS", file) : product;
  if (overflow || product != header.points)
    throw Error("ingest", "PCD POINTS is not WIDTH times HEIGHT", std::to_string(header.points),
                std::to_string(width) + " x " + std::to_string(height), entry(entries, "HEIGHT", file).where);
  const Entry& data = entry(entries, "DATA", file);
  const std::string kind = data.words.size() == 1 ? lower_case(data.words[0]) : "";
  if (kind == "ascii")
    header.data = PcdHeader::Data::ascii;
  else if (kind == "binary")
    header.data = PcdHeader::Data::binary;
  else if (kind == "binary_compressed")
    header.data = PcdHeader::Data::compressed;
  else
    throw Error("ingest", "PCD DATA", shown(kind), "ascii, binary or binary_compressed", data.where);
  return header;
}

}  // namespace scarp
