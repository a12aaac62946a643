// SPDX-License-Identifier: MIT
// What burin bench world measures is what it says.
#include "bench/world/world_bench.hpp"

#include <gtest/gtest.h>

#include "tests/support/places.hpp"
#include "tests/support/run_command.hpp"

namespace burin::bench {

TEST(WorldBench, TheMadeWorldHasSoManyNamedObjectsAndTriangles) {
    const Workplace place;
    WorldBenchTask task;
    task.folder = (place / "").string();
    task.objects = 12;
    task.triangles_each = 487;
    task.runs = 2;
    const Result<WorldBenchFigures> figures = measure_world(task);
    ASSERT_TRUE(figures) << figures.error().line();
    EXPECT_EQ(figures->names, 12u);
    EXPECT_EQ(figures->triangles, 12u * 487u);
    EXPECT_EQ(figures->total_s.size(), 2u);
    EXPECT_FALSE(figures->coin);
    EXPECT_FALSE(figures->without_coin.empty());
    EXPECT_EQ(place.files(), 0u) << "the made world is gone";
}

TEST(WorldBench, TellsWhyThereIsNoTimeOfCoin) {
    const Workplace place;
    place.write("w.wrl", made_world(2, 10));
    WorldBenchTask task;
    task.world = (place / "w.wrl").string();
    task.coin = "/bin/false";
    task.runs = 1;
    const Result<WorldBenchFigures> figures = measure_world(task);
    ASSERT_TRUE(figures) << figures.error().line();
    EXPECT_FALSE(figures->coin);
    EXPECT_NE(world_bench_table(*figures).find("no time of Coin: /bin/false"), std::string::npos);
    EXPECT_TRUE(world_bench_json(*figures)["coin"].is_null());
    EXPECT_EQ(place.files(), 1u) << "a user's file stays";
    task.world = (place / "none.wrl").string();
    EXPECT_FALSE(measure_world(task));
}

TEST(WorldBench, CoinCountsTheSameTriangles) {
    const std::string burin = kBurinCommand;
    const Workplace place;
    const auto outcome = place.run(burin + " bench world --objects 5 --triangles 33 --runs 1 --json r.json");
    EXPECT_EQ(outcome.status, 0) << outcome.output;
    const Json report = Json::parse(place.read("r.json"));
    EXPECT_EQ(report["triangles"], 165);
    if (report["coin"].is_null()) GTEST_SKIP() << report["without_coin"];
    EXPECT_EQ(report["coin"]["triangles"], 165);
}

}  // namespace burin::bench
