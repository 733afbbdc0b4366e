// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
#include "ingest/localize.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <random>

#include "ingest/crs_text.hpp"
#include "ingest/same_crs.hpp"
#include "solver/model/error.hpp"

namespace scarp {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

const std::string kGeographic =
    R"wkt(GEOGCS["WGS 84",DATUM["WGS_1984",SPHEROID["WGS 84",6378137,298.257223563]],PRIMEM["Greenwich",0],)wkt"
    R"wkt(UNIT["degree",0.0174532925199433],AUTHORITY["EPSG","4326"]])wkt";
const std::string kUtm32 =
    R"wkt(PROJCS["ETRS89 / UTM zone 32N",GEOGCS["ETRS89",DATUM["ETRS89",SPHEROID["GRS 1980",6378137,298.2572]],)wkt"
    R"wkt(UNIT["degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],UNIT["metre",1],)wkt"
    R"wkt(AXIS["Easting",EAST],AXIS["Northing",NORTH],AUTHORITY["EPSG","25832"]])wkt";
const std::string kFeetProjection =
    R"wkt(PROJCS["NAD83 / Oregon (ft)",GEOGCS["NAD83",DATUM["NAD83",SPHEROID["GRS 1980",6378137,298.2572]],)wkt"
    R"wkt(UNIT["degree",0.0174532925199433]],PROJECTION["Lambert"],UNIT["foot",0.3048]])wkt";
const std::string kUtm10 =
    R"wkt(PROJCRS["WGS 84 / UTM zone 10N",BASEGEOGCRS["WGS 84",DATUM["W",ELLIPSOID["W",6378137,298.25,)wkt"
    R"wkt(LENGTHUNIT["other",3]]]],CONVERSION["c",METHOD["m"],PARAMETER["fe",500000,LENGTHUNIT["other",3]]],)wkt"
    R"wkt(CS[Cartesian,2],AXIS["(E)",east],AXIS["(N)",north],LENGTHUNIT["metre",1],ID["EPSG",32610]])wkt";

std::string compound(const std::string& horizontal, const std::string& vertical_unit) {
  return "COMPD_CS[\"both\"," + horizontal + ",VERT_CS[\"heights\",VERT_DATUM[\"d\",2005]," + vertical_unit +
         ",AXIS[\"Up\",UP]]]";
}

PointCloud cloud_of(std::vector<Vec3> positions, std::string crs = {}) {
  PointCloud cloud;
  cloud.positions = std::move(positions);
  cloud.site.crs = std::move(crs);
  return cloud;
}

std::string message_of(const std::function<void()>& f) {
  try {
    f();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Box3 box(const Vec3& min, const Vec3& max) { return {min, max}; }

TEST(ProjectOrigin, LocalSitesStayWhereTheyAre) {
  EXPECT_EQ(project_origin(box({-9999, 0, 0}, {9999.9, 50, 3000})), (Vec3{0, 0, 0}));
  EXPECT_EQ(project_origin(Box3{}), (Vec3{0, 0, 0}));
}

TEST(ProjectOrigin, IsRoundedDownToHundredMetres) {
  EXPECT_EQ(project_origin(box({512345.678, 5412399.99, 800}, {512900, 5413000, 1200})), (Vec3{512300, 5412300, 0}));
  EXPECT_EQ(project_origin(box({-20001, 5, 0}, {-19000, 60, 10})), (Vec3{-20100, 0, 0}));
  EXPECT_EQ(project_origin(box({0, 0, 12345}, {10, 10, 12400})), (Vec3{0, 0, 12300}));
}

TEST(ProjectOrigin, RefusesWhatIsNoPlace) {
  EXPECT_THROW(project_origin(box({0, 0, 0}, {2e9, 1, 1})), Error);
  EXPECT_THROW(project_origin(box({0, 0, 0}, {1, INFINITY, 1})), Error);
}

TEST(Localize, IsExactAndComesBack) {
  std::mt19937_64 generator(7);
  PointCloud cloud;
  for (int i = 0; i < 2000; ++i) {
    const double u = static_cast<double>(generator() >> 11) * 0x1p-53,
                 v = static_cast<double>(generator() >> 11) * 0x1p-53;
    cloud.positions.push_back({512345 + 900 * u, 5412399 + 700 * v, 1000 * u * v});
  }
  const std::vector<Vec3> before = cloud.positions;
  localize(cloud, {512300, 5412300, 0});
  EXPECT_EQ(cloud.site.origin, (Vec3{512300, 5412300, 0}));
  for (std::size_t i = 0; i < before.size(); ++i) {
    ASSERT_LT(std::abs(cloud.positions[i][1]), 1000);
    ASSERT_EQ(cloud.positions[i] + cloud.site.origin, before[i]);
    ASSERT_EQ(before[i][0] - cloud.positions[i][0], 512300) << "no digit is lost";
  }
  localize(cloud, {0, 0, 0});
  EXPECT_EQ(cloud.positions, before);
}

TEST(Localize, RefusesFarAndNotFiniteWithoutTouchingTheCloud) {
  for (double bad : {2e9, kNaN}) {
    PointCloud cloud = cloud_of({{500000, 1, 1}, {500000, bad, 1}});
    EXPECT_NE(message_of([&] { localize(cloud, {500000, 0, 0}); }).find("point 1"), std::string::npos);
    EXPECT_EQ(cloud.positions[0], (Vec3{500000, 1, 1}));
  }
  PointCloud cloud = cloud_of({{1, 1, 1}});
  EXPECT_THROW(localize(cloud, {0.5, 0, 0}), Error);
}

TEST(SiteBounds, AreOfFinitePointsInMetres) {
  PointCloud cloud = cloud_of({{1, 2, 10}, {kNaN, 0, 0}, {0, 9e99, INFINITY}, {3, 1, 20}});
  cloud.site.origin = {100, 0, 0};
  const Box3 bounds = site_bounds(cloud, HeightUnit::foot);
  EXPECT_EQ(bounds.min, (Vec3{101, 1, 10 * 0.3048}));
  EXPECT_EQ(bounds.max, (Vec3{103, 2, 20 * 0.3048}));
}

TEST(Heights, FeetBecomeMetres) {
  PointCloud cloud = cloud_of({{5, 6, 1000}}, compound(kUtm32, R"(UNIT["US survey foot",0.3048006096012192])"));
  heights_to_metres(cloud, HeightUnit::us_survey_foot, "a.las");
  EXPECT_DOUBLE_EQ(cloud.positions[0][2], 1200000.0 / 3937.0);
  EXPECT_EQ(cloud.positions[0][0], 5);
  EXPECT_EQ(cloud.site.crs, kUtm32) << "the vertical part would be wrong now";
  PointCloud foot = cloud_of({{0, 0, 1000}}, "EPSG:25832");
  heights_to_metres(foot, HeightUnit::foot, "a.las");
  EXPECT_DOUBLE_EQ(foot.positions[0][2], 304.8);
  EXPECT_EQ(foot.site.crs, "EPSG:25832");
}

TEST(Heights, FeetInTheCrsAreNotTakenForMetres) {
  PointCloud feet = cloud_of({{5, 6, 1000}}, compound(kUtm32, R"(UNIT["US survey foot",0.3048006096012192])"));
  const std::string message = message_of([&] { heights_to_metres(feet, HeightUnit::metre, "a.las"); });
  EXPECT_NE(message.find("height_unit"), std::string::npos) << message;
  EXPECT_NE(message.find("a.las"), std::string::npos) << message;
  const std::string axis_unit =
      "COMPOUNDCRS[\"both\"," + kUtm10 +
      R"(,VERTCRS["NAVD88",VDATUM["d"],CS[vertical,1],AXIS["H",up,LENGTHUNIT["foot",0.3048]]]])";
  feet.site.crs = axis_unit;
  EXPECT_THROW(heights_to_metres(feet, HeightUnit::metre, "a.las"), Error);
  PointCloud metres = cloud_of({{5, 6, 1000}}, compound(kUtm32, R"(UNIT["metre",1])"));
  heights_to_metres(metres, HeightUnit::metre, "a.las");
  EXPECT_EQ(metres.positions[0][2], 1000);
}

TEST(ProjectedMetres, StatedSystems) {
  const auto refusal = [](const std::string& crs) {
    return message_of([&] { require_projected_metres(cloud_of({{7.5, 46.1, 800}, {7.6, 46.2, 900}}, crs), "a.las"); });
  };
  for (const std::string& crs : {kGeographic, std::string("EPSG:4326"), std::string("epsg:4979"),
                                 std::string("EPSG:4258"), std::string("urn:ogc:def:crs:EPSG::4326"),
                                 std::string("OGC:CRS84"), compound(kGeographic, R"(UNIT["metre",1])"),
                                 std::string(R"( GEOGCRS["WGS 84",DATUM["x",ELLIPSOID["e",1,2]],CS[ellipsoidal,2]])")})
    EXPECT_NE(refusal(crs).find("degrees"), std::string::npos) << crs << " | " << refusal(crs);
  EXPECT_NE(refusal("EPSG:4978").find("geocentric"), std::string::npos);
  EXPECT_NE(refusal(R"(GEODCRS["W",DATUM["x"],CS[Cartesian,3]])").find("geocentric"), std::string::npos);
  EXPECT_NE(refusal(kFeetProjection).find("0.3048"), std::string::npos);
  for (const std::string& crs :
       {kUtm32, kUtm10, compound(kUtm32, R"(UNIT["metre",1])"), std::string(R"(LOCAL_CS["mine"])")})
    EXPECT_EQ(refusal(crs), "") << crs;
}

TEST(ProjectedMetres, CoordinatesThatLookLikeDegrees) {
  const auto refused = [](std::vector<Vec3> positions, const std::string& crs = "") {
    return !message_of([&] { require_projected_metres(cloud_of(std::move(positions), crs), "a.xyz"); }).empty();
  };
  EXPECT_TRUE(refused({{7.51, 46.10, 800}, {7.53, 46.12, 900}}));
  EXPECT_TRUE(refused({{-122.51, 46.10, 0}, {-122.41, 46.12, 5}}));
  EXPECT_TRUE(refused({{7.51, 46.10, 800}, {7.53, 46.12, 900}}, "EPSG:999999"));
  EXPECT_FALSE(refused({{1.5, 2.1, 0}, {1.8, 2.4, 8}})) << "a post near the local origin";
  EXPECT_FALSE(refused({{75.1, 46.1, 0}, {75.9, 46.9, 2}})) << "a stone in local metres";
  EXPECT_FALSE(refused({{7.5, 46, 0}, {97, 60, 200}})) << "a slope in local metres";
  EXPECT_FALSE(refused({{500007.5, 46, 0}, {500007.6, 46.1, 80}}));
  EXPECT_FALSE(refused({}));
}

TEST(SameCrs, EmptyGoesWithAnything) {
  EXPECT_NO_THROW(require_same_crs({"a", "b", "c"}, {"", kUtm32, ""}));
  EXPECT_NO_THROW(require_same_crs({"a", "b"}, {"EPSG:25832", kUtm32})) << "one system, two texts";
  EXPECT_NO_THROW(require_same_crs({"a", "b"}, {kUtm32, compound(kUtm32, R"(UNIT["ft",0.3048])")}))
      << "heights are made metres";
  EXPECT_NO_THROW(require_same_crs({"a", "b"}, {kUtm32, " " + kUtm32 + "\n"}));
}

/// One system as ESRI's .prj, GeoTIFF and LAS files state it.
const std::string kCarolinaEsri =
    R"wkt(PROJCS["NAD_1983_HARN_StatePlane_North_Carolina_FIPS_3200",GEOGCS["GCS_North_American_1983_HARN",)wkt"
    R"wkt(DATUM["D_North_American_1983_HARN",SPHEROID["GRS_1980",6378137.0,298.257222101]],PRIMEM["Greenwich",0.0],)wkt"
    R"wkt(UNIT["Degree",0.0174532925199433]],PROJECTION["Lambert_Conformal_Conic"],)wkt"
    R"wkt(PARAMETER["False_Easting",609601.22],PARAMETER["False_Northing",0.0],PARAMETER["Central_Meridian",-79.0],)wkt"
    R"wkt(PARAMETER["Standard_Parallel_1",36.1666666666667],PARAMETER["Standard_Parallel_2",34.3333333333333],)wkt"
    R"wkt(PARAMETER["Latitude_Of_Origin",33.75],UNIT["Meter",1.0]])wkt";

TEST(SameCrs, DialectsOfOneSystemAreTheSame) {
  for (const std::string& text : {std::string("EPSG:3358"), std::string("urn:ogc:def:crs:EPSG::3358"),
                                  compound(kCarolinaEsri, R"(UNIT["metre",1])"), std::string("EPSG:3358+5703")}) {
    EXPECT_TRUE(same_crs(kCarolinaEsri, text)) << text;
    EXPECT_TRUE(same_crs(text, kCarolinaEsri)) << text;
  }
  EXPECT_TRUE(same_crs("EPSG:31256",
                       R"wkt(PROJCS["MGI_Austria_GK_East",GEOGCS["GCS_MGI",DATUM["D_MGI",)wkt"
                       R"wkt(SPHEROID["Bessel_1841",6377397.155,299.1528128]],PRIMEM["Greenwich",0.0],)wkt"
                       R"wkt(UNIT["Degree",0.0174532925199433]],PROJECTION["Transverse_Mercator"],)wkt"
                       R"wkt(PARAMETER["False_Easting",0.0],PARAMETER["False_Northing",-5000000.0],)wkt"
                       R"wkt(PARAMETER["Central_Meridian",16.3333333333333],PARAMETER["Scale_Factor",1.0],)wkt"
                       R"wkt(PARAMETER["Latitude_Of_Origin",0.0],UNIT["Meter",1.0]])wkt"))
      << "the register has its northing first, files do not";
}

TEST(SameCrs, SystemsThatDifferInOneThingAreNot) {
  const auto with = [](const std::string& from, const std::string& to) {
    std::string text = kCarolinaEsri;
    return text.replace(text.find(from), from.size(), to);
  };
  for (const std::string& other :
       {std::string("EPSG:32119"), with("609601.22", "609601.00"), with("-79.0", "-78.0"),
        with("36.1666666666667", "36.2"), with("D_North_American_1983_HARN", "D_North_American_1983"),
        with("UNIT[\"Meter\",1.0]", "UNIT[\"Foot_US\",0.3048006096012192]")})
    EXPECT_FALSE(same_crs(kCarolinaEsri, other)) << other;
  EXPECT_TRUE(same_crs(kCarolinaEsri, with("_HARN", ""))) << "the projection's name says nothing";
  EXPECT_FALSE(same_crs("EPSG:25832", "EPSG:32632")) << "two datums";
  EXPECT_FALSE(same_crs("EPSG:3358+5703", "EPSG:3358+6360")) << "NAVD88 in metres and in feet";
  EXPECT_FALSE(same_crs("EPSG:3358", "no system at all"));
}

TEST(SameCrs, NamesTheTwoThatDisagree) {
  const std::string message = message_of([] {
    require_same_crs({"a.las", "b.las", "c.las"}, {"", "EPSG:25832", "EPSG:25833"});
  });
  EXPECT_NE(message.find("b.las"), std::string::npos) << message;
  EXPECT_NE(message.find("c.las"), std::string::npos) << message;
  EXPECT_NE(message.find("EPSG:25833"), std::string::npos) << message;
  EXPECT_THROW(require_same_crs({"a", "b"}, {kUtm32, kUtm10}), Error);
}

TEST(CrsText, BrokenTextSaysNothing) {
  for (const std::string& text : {std::string("PROJCS[\"open"), std::string("PROJCS["), std::string("[]"),
                                  std::string(), kUtm32 + "]", std::string(100000, '['), std::string("PROJCS[\"a\",]"),
                                  std::string("EPSG:"), std::string("EPSG:1e300"), std::string("\0\xff\"", 3)}) {
    const CrsFacts facts = read_crs(text);
    EXPECT_EQ(facts.kind, CrsKind::unknown) << text.substr(0, 40);
    EXPECT_EQ(facts.epsg, 0);
    EXPECT_EQ(facts.vertical_unit, 0);
  }
  std::string deep;
  for (int i = 0; i < 100000; ++i) deep += "A[";
  EXPECT_EQ(read_crs(deep).kind, CrsKind::unknown);
}

TEST(CrsText, UnitsAndCodes) {
  EXPECT_EQ(read_crs(kUtm10).epsg, 32610);
  EXPECT_EQ(read_crs(kUtm10).horizontal_unit, 1);
  EXPECT_EQ(read_crs(kFeetProjection).horizontal_unit, 0.3048);
  EXPECT_EQ(read_crs(kUtm32).vertical_unit, 0);
  EXPECT_EQ(read_crs(R"(PROJCS["doubled "" quote",UNIT("m",1)])").horizontal_unit, 1);
}

}  // namespace
}  // namespace scarp
