#include "solvers/cell_rows.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>

namespace sluice {
namespace {

struct Cloud {
  std::vector<double> x, y, z;

  explicit Cloud(std::size_t n, unsigned seed = 7) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> in(0.0, 1.0);
    for (std::size_t i = 0; i < n; ++i) {
      x.push_back(in(random));
      y.push_back(0.5 * in(random));
      z.push_back(0.3 * in(random));
    }
  }
  void follow(std::span<const std::int32_t> order) {
    const Cloud old = *this;
    x.clear(), y.clear(), z.clear();
    for (const std::int32_t k : order) {
      x.push_back(old.x[static_cast<std::size_t>(k)]);
      y.push_back(old.y[static_cast<std::size_t>(k)]);
      z.push_back(old.z[static_cast<std::size_t>(k)]);
    }
  }
  /// Each by up to `by` along every axis.
  void wander(double by) {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> step(-by, by);
    for (std::size_t i = 0; i < x.size(); ++i) x[i] += step(random), y[i] += step(random), z[i] += step(random);
  }
  Vec3d at(std::size_t i) const { return {x[i], y[i], z[i]}; }
};

const Box domain{{-0.1, -0.1, -0.1}, {1.1, 0.6, 0.4}};

/// Every particle within the radius is in exactly one run.
void expect_all_found(const RowIndex& index, const Cloud& cloud, const Vec3d& point, double travel) {
  std::multiset<std::size_t> found;
  for (const sluice::Run& run : index.neighbours(point, travel)) {
    for (auto j = run.begin; j < run.end; ++j) found.insert(static_cast<std::size_t>(j));
  }
  const double radius = index.geometry().radius_m;
  for (std::size_t j = 0; j < cloud.x.size(); ++j) {
    const Vec3d d = cloud.at(j) - point;
    if (dot(d, d) < radius * radius) {
      EXPECT_EQ(found.count(j), 1U) << "particle " << j;
    } else {
      EXPECT_LE(found.count(j), 1U);
    }
  }
}

TEST(RowIndex, FindsEveryNeighbourOnce) {
  Cloud cloud(3000);
  RowIndex index({domain, 0.09, 0.004, 0.015});
  index.sort(cloud.x, cloud.y, cloud.z, {}, 2);
  cloud.follow(index.order());
  for (std::size_t i = 0; i < 300; ++i) expect_all_found(index, cloud, cloud.at(i * 10), 0.0);
}

TEST(RowIndex, StillFindsThemAfterTheAllowedTravel) {
  Cloud cloud(3000);
  const double travel = 0.004;
  RowIndex index({domain, 0.09, travel, 0.015});
  index.sort(cloud.x, cloud.y, cloud.z, {}, 1);
  cloud.follow(index.order());
  const RowGeometry& geometry = index.geometry();
  std::vector<RowIndex::Row> row;
  for (std::size_t i = 0; i < cloud.x.size(); ++i)
    row.push_back(index.row_search(geometry.row_y(cloud.y[i]), geometry.row_z(cloud.z[i])));
  cloud.wander(travel / 1.8);
  for (std::size_t i = 0; i < 300; ++i) expect_all_found(index, cloud, cloud.at(i * 10), travel);
  // A particle that has left the row it was sorted into is looked up by that row.
  for (std::size_t i = 0; i < cloud.x.size(); i += 10) {
    const auto runs = index.neighbours(cloud.at(i), row[i], travel);
    const bool own =
        static_cast<std::size_t>(runs.front().begin) <= i && i < static_cast<std::size_t>(runs.front().end);
    EXPECT_TRUE(own);
  }
}

/// As the pair sums do: every particle with those after it in its own row, and with those of the rows after it.
TEST(RowIndex, ForwardRunsMeetEveryPairOnce) {
  Cloud cloud(1500);
  const double travel = 0.004;
  RowIndex index({domain, 0.09, travel, 0.015});
  index.sort(cloud.x, cloud.y, cloud.z, {}, 1);
  cloud.follow(index.order());
  const Cloud sorted = cloud;
  cloud.wander(travel / 1.8);
  std::set<std::pair<std::size_t, std::size_t>> met;
  const RowGeometry& g = index.geometry();
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    auto runs = index.forward(cloud.at(i), index.row_search(g.row_y(sorted.y[i]), g.row_z(sorted.z[i])), travel);
    runs.front().begin = static_cast<std::int32_t>(i) + 1;
    for (const sluice::Run& run : runs)
      for (auto j = run.begin; j < run.end; ++j)
        EXPECT_TRUE(met.insert(std::minmax(i, static_cast<std::size_t>(j))).second) << i << ' ' << j;
  }
  for (std::size_t i = 0; i < cloud.x.size(); ++i) {
    for (std::size_t j = i + 1; j < cloud.x.size(); ++j) {
      const Vec3d d = cloud.at(j) - cloud.at(i);
      const bool near = dot(d, d) < g.radius_m * g.radius_m;
      EXPECT_TRUE(!near || met.contains({i, j})) << i << ' ' << j;
    }
  }
}

TEST(RowIndex, OrderIsTheSameForAnyNumberOfThreads) {
  const Cloud cloud(5000);
  RowIndex one({domain, 0.09, 0.004, 0.015});
  one.sort(cloud.x, cloud.y, cloud.z, {}, 1);
  for (const int threads : {2, 3, 4}) {
    RowIndex many({domain, 0.09, 0.004, 0.015});
    many.sort(cloud.x, cloud.y, cloud.z, {}, threads);
    EXPECT_TRUE(std::equal(one.order().begin(), one.order().end(), many.order().begin(), many.order().end()));
  }
}

TEST(RowIndex, DropsThoseWhoLeave) {
  const Cloud cloud(100);
  std::vector<std::uint8_t> leaves(100, 0);
  leaves[3] = leaves[50] = 1;
  RowIndex index({domain, 0.09, 0.004, 0.015});
  index.sort(cloud.x, cloud.y, cloud.z, leaves, 2);
  EXPECT_EQ(index.size(), 98);
  for (const std::int32_t k : index.order()) EXPECT_TRUE(k != 3 && k != 50);
}

TEST(RowIndex, EmptyAndSparseSetsHaveEmptyRuns) {
  RowIndex index({domain, 0.09, 0.004, 0.015});
  index.sort({}, {}, {}, {}, 2);
  for (const sluice::Run& run : index.neighbours({0.5, 0.2, 0.1}, 0)) EXPECT_EQ(run.begin, run.end);
  EXPECT_FALSE(index.any_near({0.5, 0.2, 0.1}));
}

TEST(Proximity, MissesNoPointThatHasAParticleInReach) {
  Cloud cloud(40);
  RowIndex index({domain, 0.09, 0.004, 0.015});
  index.sort(cloud.x, cloud.y, cloud.z, {}, 1);
  const Proximity proximity(index);
  for (std::size_t j = 0; j < cloud.x.size(); ++j) cloud.x[j] += j % 2 == 0 ? 0.004 : -0.004;  // as far as it may
  const Cloud points(2000, 11);
  int far = 0;
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    double least2 = 1;
    for (std::size_t j = 0; j < cloud.x.size(); ++j) {
      const Vec3d d = cloud.at(j) - points.at(i);
      least2 = std::min(least2, dot(d, d));
    }
    if (least2 <= 0.09 * 0.09) {
      EXPECT_TRUE(proximity.any_near(points.at(i)));
    }
    far += !proximity.any_near(points.at(i));
  }
  EXPECT_GT(far, 50);
}

}  // namespace
}  // namespace sluice
