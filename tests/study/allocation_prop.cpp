// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <map>

#include "study/assign/allocation.hpp"
#include "study/statistics/random.hpp"

namespace burin::study {
namespace {

RC_GTEST_PROP(StudyAllocation, IsBalancedWithinEveryBlockOfEveryStratum, (std::uint64_t seed)) {
    Random random(seed);
    std::vector<unsigned> ratios(1 + random.below(5));
    unsigned sum = 0;
    for (unsigned& r : ratios) sum += r = static_cast<unsigned>(1 + random.below(3));
    const std::vector<unsigned> blocks{sum, 2 * sum, 3 * sum};
    for (std::uint64_t stratum = 0; stratum < 4; ++stratum) {
        const auto list = allocate(ratios, blocks, seed, stratum, 200);
        RC_ASSERT(list.size() == 200u);
        std::map<std::size_t, std::map<std::size_t, std::size_t>> counts;
        for (const AllocationPlace& p : list) ++counts[p.block][p.group];
        counts.erase(list.back().block);  // may be cut off
        for (const auto& [block, of_group] : counts) {
            for (std::size_t g = 0; g < ratios.size(); ++g)
                RC_ASSERT(of_group.at(g) * ratios[0] == of_group.at(0) * ratios[g]);
        }
        // The list of fewer places is its beginning.
        const auto shorter = allocate(ratios, blocks, seed, stratum, 37);
        for (std::size_t i = 0; i < shorter.size(); ++i) RC_ASSERT(shorter[i].group == list[i].group);
    }
}

}  // namespace
}  // namespace burin::study
