// SPDX-License-Identifier: MIT
#include "study/assign/allocation.hpp"

#include <algorithm>
#include <numeric>

#include "base/error.hpp"
#include "study/statistics/random.hpp"

namespace burin::study {

std::vector<AllocationPlace> allocate(std::span<const unsigned> ratios, std::span<const unsigned> blocks,
                                      std::uint64_t seed, std::uint64_t stratum, std::size_t places) {
    const unsigned sum = std::accumulate(ratios.begin(), ratios.end(), 0u);
    BURIN_CHECK(sum > 0 && !blocks.empty());
    std::vector<AllocationPlace> list;
    if (sum == 0 || blocks.empty()) return list;
    Random random(seed, stratum);
    for (std::size_t block = 1; list.size() < places; ++block) {
        const unsigned size = blocks[random.below(blocks.size())];
        const std::size_t begin = list.size();
        for (std::size_t group = 0; group < ratios.size(); ++group)
            list.insert(list.end(), std::size_t{size / sum} * ratios[group], {block, group});
        if (list.size() == begin) break;  // a size below the sum would never end
        // Fisher and Yates, in Durstenfeld's form.
        for (std::size_t left = list.size() - begin; left > 1; --left) {
            const std::size_t drawn = random.below(left);
            std::swap(list[begin + left - 1], list[begin + drawn]);
        }
    }
    if (list.size() > places) list.resize(places);
    return list;
}

std::vector<std::vector<std::string>> combinations(std::span<const Stratum> strata) {
    std::vector<std::vector<std::string>> all{{}};
    for (const Stratum& s : strata) {
        std::vector<std::vector<std::string>> longer;
        for (const auto& begun : all) {
            for (const std::string& code : s.codes) {
                longer.push_back(begun);
                longer.back().push_back(code);
            }
        }
        all = std::move(longer);
    }
    return all;
}

std::string stratum_label(std::span<const std::string> codes) {
    std::string label;
    for (const std::string& code : codes) label += (label.empty() ? "" : "/") + code;
    return label.empty() ? "all" : label;
}

}  // namespace burin::study
