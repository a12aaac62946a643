// SPDX-License-Identifier: MIT
#include "base/newest_slot.hpp"

#include <gtest/gtest.h>

#include <thread>

namespace burin {
namespace {

// Large enough that a torn copy is near certain to show: every word must tell the same number.
struct Wide {
    std::uint64_t sequence = 0;
    std::array<std::uint64_t, 255> echo{};
};

void fill(Wide& value, std::uint64_t sequence) {
    value.sequence = sequence;
    value.echo.fill(sequence);
}

bool whole(const Wide& value) {
    for (const std::uint64_t word : value.echo)
        if (word != value.sequence) return false;
    return true;
}

}  // namespace

TEST(NewestSlot, GivesADefaultValueBeforeTheFirstPublication) {
    NewestSlot<Wide> slot;
    EXPECT_EQ(slot.newest().sequence, 0u);
    EXPECT_EQ(slot.newest().echo[17], 0u);
}

TEST(NewestSlot, AnUnpublishedDraftIsNotSeen) {
    NewestSlot<int> slot;
    slot.draft() = 5;
    EXPECT_EQ(slot.newest(), 0);
    slot.publish();
    EXPECT_EQ(slot.newest(), 5);
}

TEST(NewestSlot, TheReaderGetsTheLastOfManyPublications) {
    NewestSlot<int> slot;
    for (int i = 1; i <= 10; ++i) {
        slot.draft() = i;
        slot.publish();
    }
    EXPECT_EQ(slot.newest(), 10);
    EXPECT_EQ(slot.newest(), 10);  // and keeps it until there is a newer one
}

TEST(NewestSlot, ABorrowedValueStaysWhileTheWriterGoesOn) {
    NewestSlot<int> slot;
    slot.draft() = 1;
    slot.publish();
    const int& borrowed = slot.newest();
    for (int i = 2; i <= 9; ++i) {
        EXPECT_NE(&slot.draft(), &borrowed);
        slot.draft() = i;
        slot.publish();
        EXPECT_EQ(borrowed, 1);
    }
    EXPECT_EQ(slot.newest(), 9);
}

TEST(NewestSlot, TwoThreadsNeverTearAValueNorGoBackInTime) {
    NewestSlot<Wide> slot;
    constexpr std::uint64_t kLast = 200'000;
    std::thread writer([&] {
        for (std::uint64_t i = 1; i <= kLast; ++i) {
            fill(slot.draft(), i);
            slot.publish();
        }
    });
    std::uint64_t seen = 0, torn = 0, backwards = 0, changes = 0;
    while (seen < kLast) {
        const Wide& value = slot.newest();
        torn += !whole(value);
        backwards += value.sequence < seen;
        changes += value.sequence > seen;
        seen = std::max(seen, value.sequence);
        torn += !whole(value);  // a borrowed value must not change under the reader either
    }
    writer.join();
    EXPECT_EQ(torn, 0u);
    EXPECT_EQ(backwards, 0u);
    EXPECT_GT(changes, 0u);
    EXPECT_EQ(slot.newest().sequence, kLast);
}

}  // namespace burin
