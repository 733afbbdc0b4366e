// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "solver/store/model_store.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>

#include "solver/model/error.hpp"
#include "solver/model/write_whole.hpp"
#include "solver/store/hdf5_store.hpp"
#include "solver/store/parameters_store.hpp"
#include "solver/store/sealed_store.hpp"
#include "tests/support/test_data.hpp"

namespace scarp {
namespace {

/// Gives every number parameter of a law its own value.
struct FillParameters {
  double next = 1.1;
  template <class T>
  void operator()(std::string_view, T& value, const Spec&) {
    if constexpr (std::is_same_v<T, double>) value = next += 0.1;
  }
};
struct CollectParameters {
  std::vector<double>& out;
  template <class T>
  void operator()(std::string_view, T& value, const Spec&) {
    if constexpr (std::is_same_v<T, double>) out.push_back(value);
  }
};

/// One material of every law in the table.
template <std::size_t i = 0>
void add_every_law(std::vector<NamedMaterial>& materials) {
  if constexpr (i < std::variant_size_v<Material>) {
    std::variant_alternative_t<i, Material> law;
    law.describe(FillParameters{1.0 + static_cast<double>(i)});
    materials.push_back({"stoff / " + std::to_string(i), law});
    add_every_law<i + 1>(materials);
  }
}

std::vector<double> parameters_of(Material material) {
  std::vector<double> out;
  std::visit([&](auto& law) { law.describe(CollectParameters{out}); }, material);
  return out;
}

Model sample_model(std::size_t count) {
  Model model;
  model.site = {{512345, 5412345, 400}, "EPSG:25832"};
  model.domain = {3,
                  0.5,
                  {0, -1, 2},
                  {10, 11, 12},
                  {Condition::fixed, Condition::roller, FaceCondition::absorbing, Face(FaceCondition::friction, 0.4)}};
  add_every_law(model.materials);
  Body body;
  body.name = "H\xc3\xa4nge/\"slide\"";
  body.lattice = {{0.5, 1.5, 2.5}, 0.25, {4, 5, 6}};
  body.end = count / 2;
  body.held = {{"base", Condition::fixed, -1, {{0, 0, 0}, {4, 5, 6}}}, {"side", Condition::roller, 1, {}}};
  body.boundary = box_mesh({{0.5, 1.5, 2.5}, {1, 2, 3}});
  model.bodies.push_back(body);
  body = {};
  body.name = "wall";
  body.begin = count / 2;
  body.end = count;
  model.bodies.push_back(body);
  VolumeReport report{"slide", 10.5, 10.25, count, 7, 6, 5, 2.5, {{"soil", 3.5}, {"rock", 7}}, false, true};
  model.volumes = {report, VolumeReport{}};
  resize_particles(model.particles, count);
  std::uint64_t state = 1;
  for_each_field(model.particles, [&]<class V>(const char*, const char*, std::vector<V>& values, const auto&) {
    using T = typename Entry<V>::Number;
    T* const numbers = reinterpret_cast<T*>(values.data());
    for (std::size_t i = 0; i < values.size() * Entry<V>::components; ++i) {
      state = state * 6364136223846793005u + 1442695040888963407u;
      numbers[i] = static_cast<T>(state >> 57);
      if constexpr (std::is_floating_point_v<T>) numbers[i] /= 3;
    }
  });
  for (std::size_t i = 0; i < count; ++i) {
    model.particles.body[i] = i < count / 2 ? 0 : 1;
    model.particles.material[i] = static_cast<std::int32_t>(i % model.materials.size());
  }
  return model;
}

void expect_same(const Model& a, const Model& b) {
  EXPECT_EQ(a.site.origin, b.site.origin);
  EXPECT_EQ(a.site.crs, b.site.crs);
  EXPECT_EQ(a.domain.dimension, b.domain.dimension);
  EXPECT_EQ(a.domain.cell, b.domain.cell);
  EXPECT_EQ(a.domain.min, b.domain.min);
  EXPECT_EQ(a.domain.max, b.domain.max);
  EXPECT_EQ(a.domain.faces, b.domain.faces);
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t i = 0; i < a.materials.size(); ++i) {
    EXPECT_EQ(a.materials[i].name, b.materials[i].name);
    EXPECT_EQ(a.materials[i].law.index(), b.materials[i].law.index());
    EXPECT_EQ(parameters_of(a.materials[i].law), parameters_of(b.materials[i].law));
  }
  ASSERT_EQ(a.bodies.size(), b.bodies.size());
  for (std::size_t i = 0; i < a.bodies.size(); ++i) {
    const Body &p = a.bodies[i], &q = b.bodies[i];
    EXPECT_EQ(p.name, q.name);
    EXPECT_EQ(p.formulation, q.formulation);
    EXPECT_EQ(p.lattice.origin, q.lattice.origin);
    EXPECT_EQ(p.lattice.cell, q.lattice.cell);
    EXPECT_EQ(p.lattice.cells, q.lattice.cells);
    EXPECT_EQ(std::pair(p.begin, p.end), std::pair(q.begin, q.end));
    EXPECT_EQ(p.boundary.vertices, q.boundary.vertices);
    EXPECT_EQ(p.boundary.triangles, q.boundary.triangles);
    ASSERT_EQ(p.held.size(), q.held.size());
    for (std::size_t h = 0; h < p.held.size(); ++h) {
      EXPECT_EQ(p.held[h].name, q.held[h].name);
      EXPECT_EQ(p.held[h].condition, q.held[h].condition);
      EXPECT_EQ(p.held[h].axis, q.held[h].axis);
      EXPECT_EQ(p.held[h].nodes, q.held[h].nodes);
    }
  }
  ASSERT_EQ(a.volumes.size(), b.volumes.size());
  for (std::size_t i = 0; i < a.volumes.size(); ++i) {
    const VolumeReport &p = a.volumes[i], &q = b.volumes[i];
    EXPECT_EQ(p.body, q.body);
    EXPECT_EQ(p.input_volume, q.input_volume);
    EXPECT_EQ(p.particle_volume, q.particle_volume);
    EXPECT_EQ(p.particles, q.particles);
    EXPECT_EQ(p.cells, q.cells);
    EXPECT_EQ(p.full_cells, q.full_cells);
    EXPECT_EQ(p.isolated_particles, q.isolated_particles);
    EXPECT_EQ(p.mean_thickness_in_cells, q.mean_thickness_in_cells);
    EXPECT_EQ(p.volume_by_material, q.volume_by_material);
    EXPECT_EQ(p.closed, q.closed);
    EXPECT_EQ(p.self_intersecting, q.self_intersecting);
  }
  EXPECT_EQ(a.particles.id, b.particles.id);
  // Field by field, whatever the list holds: compare through bytes, so that a new field is covered too.
  std::vector<std::string> fields_a, fields_b;
  const auto collect = [](std::vector<std::string>& out) {
    return [&out]<class V>(const char* name, const char*, const std::vector<V>& values, const auto&) {
      out.push_back(name + std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(V)));
    };
  };
  for_each_field(a.particles, collect(fields_a));
  for_each_field(b.particles, collect(fields_b));
  EXPECT_TRUE(fields_a == fields_b);
}

std::string bytes_of(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

TEST(ModelStore, GivesBackEverything) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  for (const std::size_t count : {std::size_t{0}, std::size_t{10}, std::size_t{70001}}) {
    const Model model = sample_model(count);
    write_model(path, model);
    expect_same(model, read_model(path));
  }
  EXPECT_FALSE(std::filesystem::exists(path.string() + ".tmp"));
}

TEST(ModelStore, AFlippedByteAnywhereIsRefused) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  write_model(path, sample_model(40));
  const std::string whole = bytes_of(path);
  for (std::size_t at = 3; at < whole.size(); at += 499) {
    std::string damaged = whole;
    damaged[at] = static_cast<char>(damaged[at] ^ 0x10);
    std::ofstream(path, std::ios::binary) << damaged;
    EXPECT_THROW(read_model(path), Error) << at;
  }
}

TEST(ModelStore, AStateThatIsNotThereStaysAway) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  Model model = sample_model(40);
  const std::vector<Vec3> velocity = model.particles.velocity;
  drop_state(model.particles);
  model.particles.velocity = velocity;
  write_model(path, model);
  const Particles back = read_model(path).particles;
  EXPECT_EQ(back.velocity, velocity);
  EXPECT_EQ(back.reference_position, model.particles.reference_position);
  EXPECT_TRUE(back.position.empty() && back.stress.empty() && back.hardening.empty());
  Particles whole = back;
  complete_state(whole);
  EXPECT_EQ(whole.position, back.reference_position);
  EXPECT_EQ(whole.velocity, velocity);
  EXPECT_EQ(whole.deformation_gradient, std::vector<Mat3>(40, kIdentity));
}

TEST(ModelStore, ATruncatedModelIsRefused) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  write_model(path, sample_model(40));
  const std::string whole = bytes_of(path);
  for (const std::size_t length : {std::size_t{0}, std::size_t{23}, whole.size() / 2, whole.size() - 1}) {
    std::ofstream(path, std::ios::binary) << whole.substr(0, length);
    EXPECT_THROW(read_model(path), Error) << length;
  }
}

TEST(ModelStore, AnotherVersionIsRefusedAndNamed) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  Hdf5Writer file(path);
  write_format(file, "scarp-model", 99);
  file.finish();
  try {
    read_model(path);
    ADD_FAILURE() << "version 99 was read";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("found 99; allowed: 4"), std::string::npos) << error.what();
  }
}

TEST(ModelStore, InconsistentModelsAreRefused) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "model.hdf";
  const auto refused = [&](auto&& spoil) {
    Model model = sample_model(10);
    spoil(model);
    try {
      write_model(path, model);
      read_model(path);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_FALSE(refused([](Model&) {}));
  EXPECT_TRUE(refused([](Model& m) { m.bodies[1].end = 11; }));
  EXPECT_TRUE(refused([](Model& m) { m.bodies[1].begin = 12; }));
  EXPECT_TRUE(refused([](Model& m) { m.particles.material[3] = 1000; }));
  EXPECT_TRUE(refused([](Model& m) { m.particles.body[3] = -1; }));
  EXPECT_TRUE(refused([](Model& m) { m.particles.mass.pop_back(); }));
  EXPECT_TRUE(refused([](Model& m) { m.bodies[0].held[0].nodes[0][2] = 7; }));
  EXPECT_TRUE(refused([](Model& m) { m.bodies[0].lattice.cells[0] = -1; }));
}

TEST(Hdf5Reader, AskingForAnotherTypeOrShapeIsAnError) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  Hdf5Writer file(path);
  file.array("/small", std::vector<double>{1, 2, 3});
  file.finish();
  const Hdf5Reader reader(path);
  EXPECT_EQ(reader.array<double>("/small"), (std::vector<double>{1, 2, 3}));
  EXPECT_THROW(reader.array<float>("/small"), Error);
  EXPECT_THROW(reader.array<Vec3>("/small"), Error);
  EXPECT_THROW(reader.array<double>("/absent"), Error);
  EXPECT_THROW(reader.text("/small"), Error);
}

TEST(Hdf5Reader, AnArrayThatClaimsMoreThanTheFileHoldsIsNotAllocated) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  const std::string make = "/usr/bin/python3 -c \"import h5py; f = h5py.File('" + path.string() +
                           "', 'w'); f.create_dataset('big', (10**14,), 'f8', chunks=(1024,), compression=1)\"";
  if (std::system((make + " 2>/dev/null").c_str()) != 0) GTEST_SKIP() << "no h5py for /usr/bin/python3";
  std::string bytes = bytes_of(path);
  append_seal(bytes);
  write_whole(path, bytes);
  const Hdf5Reader reader(path);
  EXPECT_THROW(reader.array<double>("/big"), Error);
}

std::ptrdiff_t open_files() { return std::distance(std::filesystem::directory_iterator("/proc/self/fd"), {}); }

// A leaked id keeps its file open.
TEST(Hdf5Reader, FailuresLeakNoIdsAndPrintNothing) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  Hdf5Writer file(path);
  file.array("/there", std::vector<double>{1});
  file.finish();
  const std::ptrdiff_t before = open_files();
  testing::internal::CaptureStderr();
  for (int i = 0; i < 50; ++i) {
    const Hdf5Reader reader(path);
    EXPECT_THROW(reader.array<double>("/absent"), Error);
    EXPECT_THROW(reader.array<float>("/there"), Error);
    EXPECT_THROW(reader.text("/there"), Error);
    EXPECT_THROW(reader.names("/there"), Error);
    EXPECT_THROW(reader.text_attribute("/there", "unit"), Error);
    EXPECT_THROW(reader.attribute<double>("/absent", "unit"), Error);
  }
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(open_files(), before);
}

/// What a law of tomorrow might hold.
enum class Colour { red, green };
struct Inner {
  double a = 1;
  template <class V>
  void describe(V&& v) {
    v("a", a, Spec{});
  }
};
struct Tomorrow {
  bool flag = false;
  int count = 0;
  std::string text;
  Colour colour = Colour::red;
  std::optional<double> given, absent{3.0};
  std::optional<Inner> inner;
  std::vector<Vec2> table;
  Vec3 axis{0, 0, 0};
  template <class V>
  void describe(V&& v) {
    v("flag", flag, Spec{});
    v("count", count, Spec{});
    v("text", text, Spec{});
    v("colour", colour, Spec{});
    v("given", given, Spec{});
    v("absent", absent, Spec{});
    v("inner", inner, Spec{});
    v("table", table, Spec{});
    v("axis", axis, Spec{});
  }
};

}  // namespace
template <>
struct enum_names<Colour> {
  static constexpr std::array<std::pair<std::string_view, Colour>, 2> value{
      {{"red", Colour::red}, {"green", Colour::green}}};
};
namespace {

TEST(ParametersStore, EveryKindOfOptionRoundTrips) {
  test::TemporaryFolder folder;
  const auto path = folder.path() / "a.hdf";
  Hdf5Writer file(path);
  file.group("/p");
  Tomorrow law{true, -5, "x y", Colour::green, 2.5, std::nullopt, Inner{7}, {{1, 2}, {3, 4}}, {1, 2, 3}};
  law.describe(ParameterWriter(file, "/p"));
  file.finish();
  const Hdf5Reader reader(path);
  Tomorrow back;
  back.describe(ParameterReader(reader, "/p"));
  EXPECT_TRUE(back.flag);
  EXPECT_EQ(back.count, -5);
  EXPECT_EQ(back.text, "x y");
  EXPECT_EQ(back.colour, Colour::green);
  EXPECT_EQ(back.given, 2.5);
  EXPECT_FALSE(back.absent);
  ASSERT_TRUE(back.inner);
  EXPECT_EQ(back.inner->a, 7);
  EXPECT_EQ(back.table, law.table);
  EXPECT_EQ(back.axis, law.axis);
}

TEST(SealedStore, ChecksumTellsEveryChangedBitAndTheOrder) {
  const auto sum = [](std::string_view text) {
    Checksum checksum;
    checksum.add(text);
    return checksum.value();
  };
  const std::string text(37, 'a');
  for (std::size_t bit = 0; bit < 8 * text.size(); ++bit) {
    std::string other = text;
    other[bit / 8] = static_cast<char>(other[bit / 8] ^ (1 << bit % 8));
    EXPECT_NE(sum(other), sum(text)) << bit;
  }
  EXPECT_NE(sum("abcdefgh12345678"), sum("12345678abcdefgh"));
  Checksum parts;
  parts.add(std::string_view(text).substr(0, 16));
  parts.add(std::string_view(text).substr(16));
  EXPECT_EQ(parts.value(), sum(text));
}

}  // namespace
}  // namespace scarp
