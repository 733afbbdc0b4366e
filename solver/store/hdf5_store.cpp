// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/hdf5_store.hpp"

#include <hdf5.h>

#include <algorithm>
#include <utility>

#include "solver/model/error.hpp"
#include "solver/store/sealed_store.hpp"

namespace scarp {
namespace {

static_assert(sizeof(hid_t) == sizeof(std::int64_t), "HDF5 ids are kept as 64-bit integers in the header");

/// Owns one HDF5 id.
class Id {
 public:
  Id(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) {}
  ~Id() {
    if (id_ >= 0) close_(id_);
  }
  Id(Id&& other) noexcept : id_(std::exchange(other.id_, H5I_INVALID_HID)), close_(other.close_) {}
  Id& operator=(const Id&) = delete;
  operator hid_t() const { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Stops the library from printing for as long as it lives; what it has to say goes into our exceptions.
class Quiet {
 public:
  Quiet() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &data_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet() { H5Eset_auto2(H5E_DEFAULT, print_, data_); }
  Quiet(const Quiet&) = delete;
  Quiet& operator=(const Quiet&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* data_ = nullptr;
};

/// A file that the disk refused stays half open, and would be tried again when the program ends.
void do_nothing_at_exit() {
  static const herr_t once = H5dont_atexit();
  static_cast<void>(once);
}

/// The innermost entry of the library's error stack: the reason, rather than who passed it on.
std::string library_reason() {
  std::string reason;
  const auto take = [](unsigned depth, const H5E_error2_t* entry, void* out) -> herr_t {
    if (depth == 0 && entry->desc) *static_cast<std::string*>(out) = entry->desc;
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, take, &reason);
  H5Eclear2(H5E_DEFAULT);
  return reason;
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw Error("store", what, library_reason(), {}, {file.string()});
}

hid_t file_type(ElementType type) {
  switch (type) {
    case ElementType::float32:
      return H5T_IEEE_F32LE;
    case ElementType::float64:
      return H5T_IEEE_F64LE;
    case ElementType::int32:
      return H5T_STD_I32LE;
    case ElementType::int64:
      return H5T_STD_I64LE;
    case ElementType::uint8:
      return H5T_STD_U8LE;
    case ElementType::uint32:
      return H5T_STD_U32LE;
  }
  return H5I_INVALID_HID;
}

hid_t memory_type(ElementType type) {
  switch (type) {
    case ElementType::float32:
      return H5T_NATIVE_FLOAT;
    case ElementType::float64:
      return H5T_NATIVE_DOUBLE;
    case ElementType::int32:
      return H5T_NATIVE_INT32;
    case ElementType::int64:
      return H5T_NATIVE_INT64;
    case ElementType::uint8:
      return H5T_NATIVE_UINT8;
    case ElementType::uint32:
      return H5T_NATIVE_UINT32;
  }
  return H5I_INVALID_HID;
}

constexpr hsize_t kRowsPerChunk = 16384;

constexpr ElementType kElementTypes[] = {ElementType::float32, ElementType::float64, ElementType::int32,
                                         ElementType::int64,   ElementType::uint8,   ElementType::uint32};

const char* type_name(ElementType type) {
  switch (type) {
    case ElementType::float32:
      return "float32";
    case ElementType::float64:
      return "float64";
    case ElementType::int32:
      return "int32";
    case ElementType::int64:
      return "int64";
    case ElementType::uint8:
      return "uint8";
    case ElementType::uint32:
      return "uint32";
  }
  return "?";
}

std::string describe_shape(const ArrayShape& shape) {
  std::string text = std::to_string(shape.rows);
  if (shape.components != 1) text += " x " + std::to_string(shape.components);
  return text + " " + type_name(shape.type);
}

/// Fixed length, padded with NUL: the one kind of string that every VTK reads.
Id text_type(std::string_view value) {
  Id type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type, std::max<std::size_t>(value.size(), 1));
  H5Tset_strpad(type, H5T_STR_NULLPAD);
  if (std::any_of(value.begin(), value.end(), [](char c) { return static_cast<unsigned char>(c) > 127; }))
    H5Tset_cset(type, H5T_CSET_UTF8);
  return type;
}

std::string padded(std::string_view value) { return value.empty() ? std::string(1, '\0') : std::string(value); }

Id scalar_space() { return Id(H5Screate(H5S_SCALAR), H5Sclose); }

Id vector_space(int count) {
  const hsize_t length = static_cast<hsize_t>(count);
  return Id(H5Screate_simple(1, &length, nullptr), H5Sclose);
}

Id dataset_properties() {
  Id properties(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(properties, false);
  return properties;
}

Id create_dataset(const std::filesystem::path& shown, hid_t file, const std::string& path, hid_t stored, hid_t space,
                  hid_t properties) {
  Id dataset(H5Dcreate2(file, path.c_str(), stored, space, H5P_DEFAULT, properties, H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fail(shown, "cannot create " + path);
  return dataset;
}

/// A small one, of a whole.
void write_dataset(const std::filesystem::path& shown, hid_t file, const std::string& path, hid_t stored, hid_t memory,
                   hid_t space, const void* values) {
  const Id dataset = create_dataset(shown, file, path, stored, space, dataset_properties());
  if (H5Dwrite(dataset, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(shown, "cannot write " + path);
}

void write_attribute(const std::filesystem::path& shown, hid_t file, const std::string& object, const std::string& name,
                     hid_t stored, hid_t memory, hid_t space, const void* value) {
  const Id attribute(
      H5Acreate_by_name(file, object.c_str(), name.c_str(), stored, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (attribute < 0 || H5Awrite(attribute, memory, value) < 0)
    fail(shown, "cannot write the attribute '" + name + "' of " + object);
}

}  // namespace

Hdf5Writer::Hdf5Writer(const std::filesystem::path& path, std::filesystem::path shown)
    : path_(path), shown_(std::move(shown)) {
  do_nothing_at_exit();
  const Quiet quiet;
  const Id access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_file_locking(access, false, true);
  const Id creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  file_ = H5Fcreate(path_.c_str(), H5F_ACC_TRUNC, creation, access);
  if (file_ < 0) fail(shown_, "cannot begin the file");
}

Hdf5Writer::~Hdf5Writer() {
  const Quiet quiet;
  if (file_ >= 0) H5Fclose(file_);
}

void Hdf5Writer::group(const std::string& path) {
  const Quiet quiet;
  const Id creation(H5Pcreate(H5P_GROUP_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation, false);
  H5Pset_link_creation_order(creation, H5P_CRT_ORDER_TRACKED | H5P_CRT_ORDER_INDEXED);
  const Id group(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, creation, H5P_DEFAULT), H5Gclose);
  if (group < 0) fail(shown_, "cannot create the group " + path);
}

void Hdf5Writer::array(const std::string& path, const ArrayShape& shape, const void* values) {
  begin_array(path, shape);
  if (shape.rows > 0) rows(path, 0, shape, values);
}

void Hdf5Writer::begin_array(const std::string& path, const ArrayShape& shape) {
  const Quiet quiet;
  const int rank = shape.components == 1 ? 1 : 2;
  const hsize_t size[2] = {shape.rows, static_cast<hsize_t>(shape.components)};
  const hsize_t chunk[2] = {std::min<hsize_t>(shape.rows, kRowsPerChunk), size[1]};
  const Id space(H5Screate_simple(rank, size, nullptr), H5Sclose);
  const Id properties = dataset_properties();
  if (shape.rows > 0) {
    H5Pset_chunk(properties, rank, chunk);
    H5Pset_shuffle(properties);
    H5Pset_deflate(properties, 1);
  }
  const Id dataset = create_dataset(shown_, file_, path, file_type(shape.type), space, properties);
}

void Hdf5Writer::rows(const std::string& path, std::size_t first, const ArrayShape& part, const void* values) {
  const Quiet quiet;
  const Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fail(shown_, "cannot find " + path);
  const Id there(H5Dget_space(dataset), H5Sclose);
  hsize_t size[2] = {0, 1};
  const int rank = H5Sget_simple_extent_dims(there, size, nullptr);
  const hsize_t end = first + part.rows, rows_of_chunk = std::min<hsize_t>(size[0], kRowsPerChunk);
  if (rank != (part.components == 1 ? 1 : 2) || size[1] != static_cast<hsize_t>(part.components) || end > size[0] ||
      first % kRowsPerChunk != 0 || (end % kRowsPerChunk != 0 && end != size[0]))
    throw Error("store", "rows of " + path, std::to_string(first) + " to " + std::to_string(end),
                "whole chunks of " + describe_shape({part.type, size[0], part.components}), {shown_.string()});
  const std::size_t element = H5Tget_size(memory_type(part.type)), row = element * size[1];
  const auto* const bytes = static_cast<const unsigned char*>(values);
  for (hsize_t begin = first; begin < end; begin += kRowsPerChunk) {
    const std::size_t count = std::min<hsize_t>(kRowsPerChunk, end - begin);
    const auto packed = packer_.pack({bytes + (begin - first) * row, count * row}, element, rows_of_chunk * row);
    const hsize_t place[2] = {begin, 0};
    if (!packed || H5Dwrite_chunk(dataset, H5P_DEFAULT, 0, place, packed->size(), packed->data()) < 0)
      fail(shown_, "cannot write " + path);
  }
}

void Hdf5Writer::text(const std::string& path, std::string_view value) {
  const Quiet quiet;
  const Id type = text_type(value), space = scalar_space();
  write_dataset(shown_, file_, path, type, type, space, padded(value).data());
}

void Hdf5Writer::single(const std::string& path, ElementType type, int count, const void* value) {
  const Quiet quiet;
  const Id space = count == 0 ? scalar_space() : vector_space(count);
  write_dataset(shown_, file_, path, file_type(type), memory_type(type), space, value);
}

void Hdf5Writer::text_attribute(const std::string& object, const std::string& name, std::string_view value) {
  const Quiet quiet;
  const Id type = text_type(value), space = scalar_space();
  write_attribute(shown_, file_, object, name, type, type, space, padded(value).data());
}

void Hdf5Writer::attribute(const std::string& object, const std::string& name, ElementType type, int count,
                           const void* value) {
  const Quiet quiet;
  const Id space = count == 0 ? scalar_space() : vector_space(count);
  write_attribute(shown_, file_, object, name, file_type(type), memory_type(type), space, value);
}

void Hdf5Writer::finish() {
  const Quiet quiet;
  if (H5Fclose(std::exchange(file_, -1)) < 0) fail(shown_, "cannot complete the file");
  H5garbage_collect();  // the library keeps its buffers for files to come
  seal_file(path_, shown_);
}

Hdf5Reader::Hdf5Reader(std::filesystem::path path) : path_(std::move(path)) {
  do_nothing_at_exit();
  check_seal(path_);
  size_ = std::filesystem::file_size(path_);
  const Quiet quiet;
  file_ = H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file_ < 0) fail(path_, "cannot open the file as HDF5");
}

Hdf5Reader::~Hdf5Reader() {
  const Quiet quiet;
  if (file_ >= 0) H5Fclose(file_);
  H5garbage_collect();
}

void Hdf5Reader::refuse(const std::string& what, const std::string& found, const std::string& allowed) const {
  throw Error("store", what, found, allowed, {path_.string()});
}

void Hdf5Reader::expect_format(std::string_view format, std::int64_t version) const {
  if (!has_attribute("/", "format") || !has_attribute("/", "format_version"))
    refuse("the file does not say which format it has", {}, std::string(format));
  const std::string found = text_attribute("/", "format");
  if (found != format) refuse("this is another kind of file", found, std::string(format));
  const auto found_version = attribute<std::int64_t>("/", "format_version");
  if (found_version != version)
    refuse("version of the " + found + " format", std::to_string(found_version), std::to_string(version));
}

std::vector<std::string> Hdf5Reader::names(const std::string& group_path) const {
  const Quiet quiet;
  const Id group(H5Gopen2(file_, group_path.c_str(), H5P_DEFAULT), H5Gclose);
  H5G_info_t info;
  if (group < 0 || H5Gget_info(group, &info) < 0) fail(path_, "cannot read the group " + group_path);
  std::vector<std::string> names;
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    const ssize_t length = H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, nullptr, 0, H5P_DEFAULT);
    if (length < 0) fail(path_, "cannot list the group " + group_path);
    std::string name(static_cast<std::size_t>(length) + 1, '\0');
    H5Lget_name_by_idx(group, ".", H5_INDEX_CRT_ORDER, H5_ITER_INC, i, name.data(), name.size(), H5P_DEFAULT);
    name.pop_back();
    names.push_back(std::move(name));
  }
  return names;
}

ArrayShape Hdf5Reader::shape(const std::string& path) const {
  const Quiet quiet;
  const Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fail(path_, "cannot find the array " + path);
  const Id space(H5Dget_space(dataset), H5Sclose), type(H5Dget_type(dataset), H5Tclose);
  hsize_t size[2] = {1, 1};
  const int rank = H5Sget_simple_extent_ndims(space);
  if (rank < 0 || rank > 2) refuse("number of dimensions of " + path, std::to_string(rank), "0 to 2");
  if (rank > 0) H5Sget_simple_extent_dims(space, size, nullptr);

  ArrayShape shape;
  const auto known = std::find_if(std::begin(kElementTypes), std::end(kElementTypes),
                                  [&](ElementType t) { return H5Tequal(type, file_type(t)) > 0; });
  if (known == std::end(kElementTypes))
    refuse("type of the array " + path, {}, "float32, float64, int32, int64, uint8");
  shape.type = *known;
  // Deflate cannot pack more than 1032 bytes into one; an array that claims more is not in this file.
  const double claimed =
      static_cast<double>(size[0]) * static_cast<double>(size[1]) * static_cast<double>(H5Tget_size(type));
  const double stored = std::min(static_cast<double>(H5Dget_storage_size(dataset)), static_cast<double>(size_));
  if (claimed > 1032 * stored || size[1] > 1'000'000)
    refuse("the array " + path + " claims more values than the file holds",
           std::to_string(size[0]) + " x " + std::to_string(size[1]));
  shape.rows = static_cast<std::size_t>(size[0]);
  shape.components = static_cast<int>(size[1]);
  return shape;
}

void Hdf5Reader::read(const std::string& path, const ArrayShape& expected, void* values) const {
  const ArrayShape found = shape(path);
  if (found.type != expected.type || found.rows != expected.rows || found.components != expected.components)
    refuse("shape of the array " + path, describe_shape(found), describe_shape(expected));
  if (found.rows == 0) return;
  const Quiet quiet;
  const Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (H5Dread(dataset, memory_type(expected.type), H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0)
    fail(path_, "cannot read the array " + path);
}

namespace {

/// The length of a fixed-length string type that the file can hold; 0 if it is something else.
std::size_t text_length(hid_t type, std::uintmax_t file_size) {
  if (H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) != 0) return 0;
  const std::size_t length = H5Tget_size(type);
  return length <= file_size ? length : 0;
}

std::string without_padding(std::string text) {
  text.erase(std::find(text.begin(), text.end(), '\0'), text.end());
  return text;
}

}  // namespace

std::string Hdf5Reader::text(const std::string& path) const {
  const Quiet quiet;
  const Id dataset(H5Dopen2(file_, path.c_str(), H5P_DEFAULT), H5Dclose);
  if (dataset < 0) fail(path_, "cannot find the text " + path);
  const Id type(H5Dget_type(dataset), H5Tclose), space(H5Dget_space(dataset), H5Sclose);
  const std::size_t length = text_length(type, size_);
  if (length == 0 || H5Sget_simple_extent_npoints(space) != 1) refuse(path + " is not a text of fixed length");
  std::string value(length, '\0');
  if (H5Dread(dataset, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, value.data()) < 0) fail(path_, "cannot read " + path);
  return without_padding(std::move(value));
}

bool Hdf5Reader::has_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  const htri_t found = H5Aexists_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT);
  if (found < 0) fail(path_, "cannot find " + object);
  return found > 0;
}

std::string Hdf5Reader::text_attribute(const std::string& object, const std::string& name) const {
  const Quiet quiet;
  const std::string both = "the attribute '" + name + "' of " + object;
  const Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0) fail(path_, "cannot find " + both);
  const Id type(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  const std::size_t length = text_length(type, size_);
  if (length == 0 || H5Sget_simple_extent_npoints(space) != 1) refuse(both + " is not a text of fixed length");
  std::string value(length, '\0');
  if (H5Aread(attribute, type, value.data()) < 0) fail(path_, "cannot read " + both);
  return without_padding(std::move(value));
}

void Hdf5Reader::attribute(const std::string& object, const std::string& name, ElementType type, int count,
                           void* value) const {
  const Quiet quiet;
  const std::string both = "the attribute '" + name + "' of " + object;
  const Id attribute(H5Aopen_by_name(file_, object.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  if (attribute < 0) fail(path_, "cannot find " + both);
  const Id found(H5Aget_type(attribute), H5Tclose), space(H5Aget_space(attribute), H5Sclose);
  if (H5Tequal(found, file_type(type)) <= 0 || H5Sget_simple_extent_npoints(space) != count)
    refuse(both + " has another type or length", {}, std::to_string(count) + " " + type_name(type));
  if (H5Aread(attribute, memory_type(type), value) < 0) fail(path_, "cannot read " + both);
}

}  // namespace scarp
