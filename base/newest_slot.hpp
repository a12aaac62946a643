// SPDX-License-Identifier: MIT
// The newest-value channel: one writer, one reader, three preallocated slots, wait-free on both sides, nothing copied.
//
// Data flow: the writer fills its own slot in place and publishes it; the reader borrows the newest published slot
// until it asks again. A value not fetched in time is overwritten by a newer one. The hardest case is a writer that
// publishes many times while the reader holds a slot: the third slot keeps the two from ever sharing one.
//
// Each of the three slots is at any moment owned by the writer or by the reader, or is the middle slot. `middle_` holds
// the index of the middle slot and whether it is newer than the reader's; both sides exchange their own slot for it.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <memory>

namespace burin {

template <typename T>
class NewestSlot {
public:
    NewestSlot() : slots_(std::make_unique<std::array<T, 3>>()) {}  // on the heap: a slot may be megabytes

    // Writer only: the slot to fill. Its content is some older value, not necessarily the last one published.
    [[nodiscard]] T& draft() noexcept { return (*slots_)[writer_]; }

    // Writer only: hands the draft over and takes another slot.
    void publish() noexcept {
        // release: the reader that takes this slot sees all that was written to it; acquire: the writer may overwrite
        // the slot it receives only after the reader's last read of it.
        const std::uint32_t given = middle_.exchange(writer_ | kNew, std::memory_order_acq_rel);
        writer_ = given & kIndex;
    }

    // Reader only: the newest published value, borrowed until the next call. Before the first publication it is T{}.
    [[nodiscard]] const T& newest() noexcept {
        // relaxed: only a hint whether swapping is worth it; the exchange below orders the data.
        if ((middle_.load(std::memory_order_relaxed) & kNew) != 0) {
            // acquire: see the writer's data; release: the writer that gets our old slot sees our reads done.
            reader_ = middle_.exchange(reader_, std::memory_order_acq_rel) & kIndex;
        }
        return (*slots_)[reader_];
    }

private:
    static constexpr std::uint32_t kIndex = 3, kNew = 4;
    std::unique_ptr<std::array<T, 3>> slots_;
    alignas(64) std::uint32_t writer_ = 0;
    alignas(64) std::atomic<std::uint32_t> middle_{1};
    alignas(64) std::uint32_t reader_ = 2;
};

}  // namespace burin
