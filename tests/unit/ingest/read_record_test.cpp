// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/read_record.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <numbers>

#include "ingest/correct_record.hpp"
#include "solver/model/error.hpp"
#include "tests/support/test_data.hpp"

namespace scarp {
namespace {

class Record : public testing::Test {
 protected:
  AccelerationRecord read(const std::string& name, const std::string& text, std::optional<AccelerationUnit> unit = {}) {
    const auto path = folder_.path() / name;
    std::ofstream(path) << text;
    return read_record(path, unit);
  }
  std::string error_of(const std::string& name, const std::string& text) {
    try {
      read(name, text);
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  }
  test::TemporaryFolder folder_;
};

const std::string kHead =
    "SOME DATABASE RECORD\nA quake, 1/1/2001, A station, 90\nACCELERATION TIME SERIES IN UNITS OF G\n";

TEST_F(Record, PeerFilesHaveBothKindsOfHeader) {
  for (const char* counts : {"NPTS=     6, DT=   .0050 SEC\n", "    6    0.0050    NPTS, DT\n"}) {
    const AccelerationRecord r =
        read("a.AT2", kHead + counts + "  .1E-01 -.2E-01  3.0E-02  0.0E+00\n -1.0E-02  .5E-02\n");
    ASSERT_EQ(r.time.size(), 6u);
    EXPECT_DOUBLE_EQ(r.time[5], 0.025);
    EXPECT_DOUBLE_EQ(r.acceleration[1], -0.02 * 9.80665);
    EXPECT_DOUBLE_EQ(r.acceleration[5], 0.005 * 9.80665);
  }
}

TEST_F(Record, TablesSayTheirUnit) {
  for (const auto& [text, factor] : {std::pair("time (s), acceleration (g)\n0, 1\n0.1, 2\n", 9.80665),
                                     std::pair("# t [s]; a [cm/s2]\n0; 1\n0.1; 2\n", 0.01),
                                     std::pair("time acceleration(m/s^2)\n0 1\n0.1 2\n", 1.0)}) {
    const AccelerationRecord r = read("a.csv", text);
    ASSERT_EQ(r.time.size(), 2u) << text;
    EXPECT_DOUBLE_EQ(r.acceleration[1], 2 * factor) << text;
  }
  EXPECT_DOUBLE_EQ(read("a.csv", "0,1\n1,2\n", AccelerationUnit::gravities).acceleration[0], 9.80665);
}

TEST_F(Record, WrongOnesAreRefused) {
  EXPECT_NE(error_of("a.csv", "0,1\n1,2\n").find("unit"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "t,a (g)\n0,1\n0,2\n").find("must rise"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "t,a (g)\n0,1,3\n").find("columns"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "t,a (g)\n0,1\n").find("at least two"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "t,a (g)\n0,1\n1,x\n").find("a.csv:3"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "t,a (g)\n0,1\n1,nan\n").find("finite"), std::string::npos);
  EXPECT_NE(error_of("a.csv", "").find("at least two"), std::string::npos);
  EXPECT_NE(error_of("a.at2", kHead + "1 2 3\n").find("no NPTS"), std::string::npos);
  EXPECT_NE(error_of("a.at2", kHead + "NPTS= 3, DT= 0 SEC\n1 2 3\n").find("interval"), std::string::npos);
  EXPECT_NE(error_of("a.at2", kHead + "NPTS= 4, DT= 0.1 SEC\n1 2 3\n").find("fewer"), std::string::npos);
  EXPECT_NE(error_of("a.at2", kHead + "NPTS= 2, DT= 0.1 SEC\n1 2 3\n").find("more"), std::string::npos);
  EXPECT_NE(error_of("a.at2", "NPTS= 2, DT= 0.1 SEC\n1 2\n").find("unit"), std::string::npos);
}

TEST(GroundMotionOf, IntegratesItsRecordExactly) {
  const GroundMotion m(AccelerationRecord{{1, 2, 4}, {0, 3, -1}}, 0.5);  // from 0.5 s on
  EXPECT_EQ(m.velocity(0.5), 0);
  EXPECT_DOUBLE_EQ(m.acceleration(1), 1.5);
  EXPECT_DOUBLE_EQ(m.velocity(1.5), 1.5);
  EXPECT_DOUBLE_EQ(m.displacement(1.5), 0.5);  // 3 t^3 / 6
  EXPECT_DOUBLE_EQ(m.velocity(3.5), 3.5);
  EXPECT_DOUBLE_EQ(m.acceleration(4), 0);
  EXPECT_DOUBLE_EQ(m.displacement(4.5), m.displacement(3.5) + 3.5);
  // Between samples, against fine sums.
  double v = 0, u = 0;
  const int steps = 200000;
  for (int i = 0; i < steps; ++i) {
    const double dt = 2.7 / steps, a = m.acceleration(0.5 + (i + 0.5) * dt);
    u += dt * (v + 0.5 * dt * a);
    v += dt * a;
  }
  EXPECT_NEAR(m.velocity(3.2), v, 1e-8);
  EXPECT_NEAR(m.displacement(3.2), u, 1e-8);
}

TEST(CorrectRecord, TakesOutTheDriftOfItsDegree) {
  const auto record = [](double offset, double slope) {
    AccelerationRecord r;
    for (int i = 0; i <= 2000; ++i) {
      const double t = 0.01 * i, s = (t - 10) / 4;
      r.time.push_back(t);
      r.acceleration.push_back(std::exp(-s * s) * std::sin(6 * (t - 10)) + offset + slope * t);
    }
    return r;
  };
  AccelerationRecord clean = record(0, 0), drifting = record(0.02, -0.001);
  EXPECT_GT(std::abs(report_of(GroundMotion(drifting, 0)).end_displacement), 0.1);
  correct(clean, Baseline::linear, {});
  correct(drifting, Baseline::linear, {});
  for (std::size_t i = 0; i < clean.time.size(); ++i)
    EXPECT_NEAR(drifting.acceleration[i], clean.acceleration[i], 1e-10);  // the fit is a projection
  EXPECT_LT(std::abs(report_of(GroundMotion(drifting, 0)).end_velocity), 1e-3);
}

TEST(CorrectRecord, AHighPassKeepsPhaseAndTakesOutSlowMotion) {
  AccelerationRecord r;
  for (int i = 0; i <= 4000; ++i) {
    const double t = 0.01 * i, s = (t - 20) / 5;
    r.time.push_back(t);
    r.acceleration.push_back(std::exp(-s * s) *
                             (std::sin(2 * std::numbers::pi * 2 * t) + std::sin(2 * std::numbers::pi * 0.02 * t)));
  }
  AccelerationRecord high = r;
  correct(high, Baseline::none, 0.2);
  double worst = 0;
  for (std::size_t i = 0; i < r.time.size(); ++i) {
    const double t = r.time[i], s = (t - 20) / 5;
    worst = std::max(worst, std::abs(high.acceleration[i] - std::exp(-s * s) * std::sin(2 * std::numbers::pi * 2 * t)));
  }
  EXPECT_LT(worst, 0.06);  // |H|^2 at 0.02 Hz of 0.2 Hz is 1e-4; the envelope has 0.1 Hz
  EXPECT_THROW(correct(high, Baseline::none, 60.0), Error);
  high.time[7] += 0.005;
  EXPECT_THROW(correct(high, Baseline::none, 0.2), Error);
}

}  // namespace
}  // namespace scarp
