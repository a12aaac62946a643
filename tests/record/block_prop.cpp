// SPDX-License-Identifier: MIT
// What goes into a block or into text comes out with the same bits, whatever it is.
#include "record/block.hpp"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <bit>
#include <cmath>
#include <cstdlib>

#include "tests/support/property_cases.hpp"

namespace burin::record {

RC_GTEST_PROP(Block, KeepsEveryBit, ()) {
    const auto kinds =
        *rc::gen::resize(20, rc::gen::nonEmpty(rc::gen::container<std::vector<int>>(rc::gen::inRange(0, 3))));
    const auto rows = *rc::gen::inRange<std::uint32_t>(1, 50);
    const auto tick0 = *rc::gen::arbitrary<std::int64_t>();
    std::vector<ColumnType> types;
    for (const int kind : kinds) types.push_back(static_cast<ColumnType>(kind));
    Block block(types);
    std::vector<std::vector<Word>> kept;
    for (std::uint32_t row = 0; row < rows; ++row) {
        std::vector<Word> words;
        for (const ColumnType type : types) {
            const auto word = *rc::gen::arbitrary<Word>();
            words.push_back(type == ColumnType::u32 ? word & 0xffffffffu : word);
        }
        block.add(words);
        kept.push_back(std::move(words));
    }
    const auto packed = pack(block, {0, tick0, 0, -5});
    RC_ASSERT(packed.has_value());
    const auto back = unpack(*packed, types, "block");
    RC_ASSERT(back.has_value());
    RC_ASSERT(back->rows() == rows);
    for (std::uint32_t row = 0; row < rows; ++row)
        for (std::size_t c = 0; c < types.size(); ++c) RC_ASSERT(back->at(c, row) == kept[row][c]);
}

RC_GTEST_PROP(Columns, NumbersReadBackFromTextWithTheSameBits, ()) {
    const auto word = *rc::gen::arbitrary<Word>();
    const auto value = std::bit_cast<double>(word);
    const std::string text = text_of(word, ColumnType::f64);
    const double back = std::strtod(text.c_str(), nullptr);
    if (std::isnan(value)) {
        RC_ASSERT(std::isnan(back));
    } else {
        RC_ASSERT(std::bit_cast<Word>(back) == word);
    }
    RC_ASSERT(std::strtoll(text_of(word, ColumnType::i64).c_str(), nullptr, 10) == static_cast<std::int64_t>(word));
}

}  // namespace burin::record
