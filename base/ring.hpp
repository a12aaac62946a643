// SPDX-License-Identifier: MIT
// The ring channel: one producer, one consumer, bounded, wait-free on both sides, values in order, none lost silently:
// a push into a full ring returns false and is counted.
#pragma once

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>

namespace burin {

template <typename T>
class Ring {
public:
    // Rounds the capacity up to a power of two. The only allocation.
    explicit Ring(std::size_t least_capacity)
        : mask_(std::bit_ceil(least_capacity < 2 ? std::size_t{2} : least_capacity) - 1),
          values_(std::make_unique<T[]>(mask_ + 1)) {}

    [[nodiscard]] std::size_t capacity() const noexcept { return mask_ + 1; }

    // Producer only.
    bool push(const T& value) noexcept {
        const std::size_t tail = tail_.load(std::memory_order_relaxed);  // only the producer writes it
        // acquire: the consumer has finished reading the slot we are about to overwrite.
        if (tail - head_.load(std::memory_order_acquire) > mask_) {
            refused_.fetch_add(1, std::memory_order_relaxed);  // a statistic; orders nothing
            return false;
        }
        values_[tail & mask_] = value;
        tail_.store(tail + 1, std::memory_order_release);  // the value is visible before the new tail
        return true;
    }

    // Consumer only: the oldest value, which stays until it is popped; null when the ring is empty.
    [[nodiscard]] const T* oldest() const noexcept {
        const std::size_t head = head_.load(std::memory_order_relaxed);     // only the consumer writes it
        if (head == tail_.load(std::memory_order_acquire)) return nullptr;  // acquire: pairs with push's release
        return &values_[head & mask_];
    }

    // Consumer only: the number of values that wait; more may come meanwhile.
    [[nodiscard]] std::size_t waiting() const noexcept {
        // acquire: pairs with push's release, so that the values counted are seen whole.
        return tail_.load(std::memory_order_acquire) - head_.load(std::memory_order_relaxed);
    }
    // Consumer only: the value behind `older` others, which stays until it is popped. older < waiting().
    [[nodiscard]] const T& at(std::size_t older) const noexcept {
        return values_[(head_.load(std::memory_order_relaxed) + older) & mask_];  // only the consumer writes head_
    }
    // Consumer only: removes the oldest value; the ring must not be empty.
    void drop() noexcept {
        // release: our reads of the slot are done before the producer may overwrite it.
        head_.store(head_.load(std::memory_order_relaxed) + 1, std::memory_order_release);
    }

    // Consumer only: true and the oldest value, or false when the ring is empty.
    bool pop(T& value) noexcept {
        const std::size_t head = head_.load(std::memory_order_relaxed);   // only the consumer writes it
        if (head == tail_.load(std::memory_order_acquire)) return false;  // acquire: pairs with push's release
        value = values_[head & mask_];
        head_.store(head + 1, std::memory_order_release);  // our read is done before the slot is free
        return true;
    }

    // Returns the number of pushes refused by a full ring. Any thread.
    [[nodiscard]] std::uint64_t refused() const noexcept { return refused_.load(std::memory_order_relaxed); }

private:
    std::size_t mask_;
    std::unique_ptr<T[]> values_;
    alignas(64) std::atomic<std::size_t> head_{0};
    alignas(64) std::atomic<std::size_t> tail_{0};
    alignas(64) std::atomic<std::uint64_t> refused_{0};
};

}  // namespace burin
