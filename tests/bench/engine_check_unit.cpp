// SPDX-License-Identifier: MIT
// burin bench engines without a device: the processor's engine beside itself, and beside one that carves cones wrongly.
#include "bench/engines/engine_check.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "tests/compute/effort.hpp"

namespace burin::bench {
namespace {

using compute::CarvingEngine;
using compute::ToolSweep;

// The processor's engine, with every cone longer by a hundredth.
class LongCones final : public CarvingEngine {
public:
    LongCones(compute::Solid solid, WorkerPool& pool) : engine_(make_cpu_engine(std::move(solid), pool)) {}
    [[nodiscard]] const char* name() const override { return "long cones"; }
    [[nodiscard]] Result<compute::Ticket> begin(std::span<const ToolSweep> sweeps) override {
        std::vector<ToolSweep> wrong(sweeps.begin(), sweeps.end());
        for (ToolSweep& sweep : wrong)
            if (auto* const cone = std::get_if<compute::ConeTool>(&sweep.shape)) cone->length_m *= 1.01;
        return engine_->begin(wrong);
    }
    [[nodiscard]] Result<compute::Ticket> begin(compute::RayBatch rays) override {
        return engine_->begin(std::move(rays));
    }
    [[nodiscard]] Result<std::optional<compute::Delta>> take(compute::Wait wait) override {
        return engine_->take(wait);
    }
    [[nodiscard]] std::size_t under_way() const override { return engine_->under_way(); }
    [[nodiscard]] const compute::Solid& solid() const override { return engine_->solid(); }
    [[nodiscard]] Result<std::uint8_t> add_material(const geometry::Material& material) override {
        return engine_->add_material(material);
    }

private:
    std::unique_ptr<CarvingEngine> engine_;
};

constexpr EngineCheckOptions kShort{
    .seed = 3, .operations = compute::test::repeated(600), .resolution = 24, .threads = 1};

Result<std::unique_ptr<CarvingEngine>> same_engine(compute::Solid solid, WorkerPool& pool) {
    return make_cpu_engine(std::move(solid), pool);
}

Result<std::unique_ptr<CarvingEngine>> long_cones(compute::Solid solid, WorkerPool& pool) {
    return std::make_unique<LongCones>(std::move(solid), pool);
}

}  // namespace

TEST(EngineCheck, OfOneEngineTwiceFindsNoEndThatDiffersInAnyWork) {
    const auto check = compare_engines(kShort, same_engine);
    ASSERT_TRUE(check) << check.error().line();
    EXPECT_EQ(check->all.ends_that_differ, 0u) << check->first_difference;
    EXPECT_NE(engine_check_table(*check).find("no end differs"), std::string::npos);
    EXPECT_EQ(check->solids, (kShort.operations + 249) / 250);
    std::set<std::string> names;
    for (const ComparedWork& work : check->work) {
        names.insert(work.name);
        if (compute::test::kSanitized) continue;  // so short that some kinds may not come
        EXPECT_GT(work.ends, 0u) << work.name;
    }
    EXPECT_EQ(names, (std::set<std::string>{"ball", "ball that smooths", "cylinder", "cone", "bullnose", "box", "mesh",
                                            "undo", "redo", "all rays of a solid"}));
}

TEST(EngineCheck, ATwiceRunSequenceComparesTheSame) {
    const auto once = compare_engines(kShort, same_engine), twice = compare_engines(kShort, same_engine);
    ASSERT_TRUE(once && twice);
    EXPECT_EQ(engine_check_json(*once), engine_check_json(*twice));
    EngineCheckOptions other = kShort;
    other.seed = 4;
    const auto of_other_seed = compare_engines(other, same_engine);
    ASSERT_TRUE(of_other_seed);
    EXPECT_NE(of_other_seed->all.ends, once->all.ends);
}

TEST(EngineCheck, OfAnEngineThatCarvesConesWronglyBlamesConesAloneAndNamesTheFirst) {
    const auto check = compare_engines(kShort, long_cones);
    ASSERT_TRUE(check) << check.error().line();
    EXPECT_EQ(check->work.front().name, "cone") << "the worst is told first";
    EXPECT_GT(check->work.front().ends_that_differ, 0u);
    EXPECT_EQ(check->all.ends_that_differ, check->work.front().ends_that_differ)
        << "neither other tools, nor undo, nor the solid's end is blamed for it";
    EXPECT_TRUE(check->first_difference.starts_with("cone, solid 1: ray ")) << check->first_difference;
    const std::string table = engine_check_table(*check);
    EXPECT_NE(table.find("ends differ, the first of them: cone"), std::string::npos) << table;
    EXPECT_EQ(engine_check_json(*check)["by_work"][0]["work"], "cone");
}

TEST(EngineCheck, RefusesALatticeThatIsNone) {
    EngineCheckOptions coarse = kShort;
    coarse.resolution = 4;
    const auto check = compare_engines(coarse, same_engine);
    ASSERT_FALSE(check);
    EXPECT_FALSE(check.error().remedy.empty());
}

}  // namespace burin::bench
