// SPDX-License-Identifier: MIT
#include "document/history.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <utility>

namespace burin::document {
namespace {

using scene::PartSteps, scene::StepWay;

template <typename Number>
Number taken(std::span<const std::byte>& from) {
    Number number{};
    std::memcpy(&number, from.data(), sizeof number);
    from = from.subspan(sizeof number);
    return number;
}

constexpr std::size_t kRunBytes = 16;
constexpr std::int64_t kFarthest = std::int64_t{1} << 60;  // of a step's number from 0

}  // namespace

// ---- What parts say

void History::follow(std::uint32_t part, const PartSteps& now) {
    Known& known = known_[part];
    if (now.walked < known.ordered) return;  // of before the order
    const bool is_made = std::exchange(known.made, now.made) != now.made;
    if (is_made) drop_forward(part);
    settle(part, now);
    if (is_made) add(part, now);
}

void History::adopt(std::uint32_t part, const PartSteps& now) {
    known_[part] = {.made = now.made, .ordered = now.walked};
    settle(part, now);
    add(part, now);
}

void History::replace_order(const History& order) {
    steps_ = order.steps_;
    done_ = order.done_;
}

// Ends what could be repeated. The part that has made a step knows that of its own.
void History::drop_forward(std::uint32_t by) {
    for (std::size_t i = done_; i < steps_.size(); ++i)
        if (steps_[i].part != by) forgotten_.insert(steps_[i].part);
    steps_.resize(done_);
}

// Leaves those steps of the part which there are, each on the side on which it is.
void History::settle(std::uint32_t part, const PartSteps& now) {
    std::vector<StepName> back, forward, gone_back, gone_forward;
    for (std::size_t i = 0; i < steps_.size(); ++i) {
        const StepName& step = steps_[i];
        const bool leads_back = i < done_;
        if (step.part != part) {
            (leads_back ? back : forward).push_back(step);
        } else if (step.number >= now.first && step.number <= now.last) {
            if (leads_back)
                (step.number <= now.done ? back : gone_back).push_back(step);
            else
                (step.number <= now.done ? gone_forward : forward).push_back(step);
        }
    }
    back.insert(back.end(), gone_forward.begin(), gone_forward.end());
    done_ = back.size();
    steps_ = std::move(back);
    steps_.insert(steps_.end(), gone_back.begin(), gone_back.end());
    steps_.insert(steps_.end(), forward.begin(), forward.end());
}

// Adds those steps of the part that are not named yet, behind those that lead back and behind those that lead forward.
void History::add(std::uint32_t part, const PartSteps& now) {
    std::set<std::int64_t> named;
    for (const StepName& step : steps_)
        if (step.part == part) named.insert(step.number);
    std::vector<StepName> back, forward;
    for (std::int64_t number = now.first; number <= now.last; ++number)
        if (!named.contains(number)) (number <= now.done ? back : forward).push_back({part, number});
    steps_.insert(steps_.begin() + static_cast<std::ptrdiff_t>(done_), back.begin(), back.end());
    done_ += back.size();
    steps_.insert(steps_.end(), forward.begin(), forward.end());
}

// ---- Going

std::optional<StepName> History::back() const {
    if (done_ == 0) return std::nullopt;
    return steps_[done_ - 1];
}

std::optional<StepName> History::forward() const {
    if (done_ == steps_.size()) return std::nullopt;
    return steps_[done_];
}

void History::ordered(std::uint32_t part, StepWay way) {
    if (way == StepWay::forget) return;
    ++known_[part].ordered;
    const std::optional<StepName> next = way == StepWay::back ? back() : forward();
    if (!next || next->part != part) return;
    if (way == StepWay::back)
        --done_;
    else
        ++done_;
}

bool History::leads_forward(std::uint32_t part) const {
    return std::any_of(steps_.begin() + static_cast<std::ptrdiff_t>(done_), steps_.end(),
                       [part](const StepName& step) { return step.part == part; });
}

// ---- As bytes

std::vector<std::byte> History::bytes() const {
    std::vector<std::uint32_t> words{static_cast<std::uint32_t>(done_)};
    for (std::size_t from = 0; from < steps_.size();) {
        std::size_t to = from + 1;
        while (to < steps_.size() && steps_[to].part == steps_[from].part &&
               steps_[to].number == steps_[to - 1].number + 1)
            ++to;
        const auto first = static_cast<std::uint64_t>(steps_[from].number);
        words.insert(words.end(), {steps_[from].part, static_cast<std::uint32_t>(to - from),
                                   static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(first >> 32)});
        from = to;
    }
    const auto bytes = std::as_bytes(std::span(words));
    return {bytes.begin(), bytes.end()};
}

std::optional<History> History::from(std::span<const std::byte> bytes) {
    if (bytes.size() < sizeof(std::uint32_t) || (bytes.size() - sizeof(std::uint32_t)) % kRunBytes != 0) return {};
    History read;
    read.done_ = taken<std::uint32_t>(bytes);
    std::map<std::uint32_t, std::int64_t> newest;  // of each part
    while (!bytes.empty()) {
        const auto part = taken<std::uint32_t>(bytes), count = taken<std::uint32_t>(bytes);
        const auto first = taken<std::int64_t>(bytes);
        // Each part goes back from its newest step alone, so its numbers rise.
        const auto before = newest.find(part);
        if (count == 0 || count > kMostSteps - read.steps_.size() || first < -kFarthest || first > kFarthest ||
            (before != newest.end() && first <= before->second))
            return {};
        for (std::uint32_t i = 0; i < count; ++i) read.steps_.push_back({part, first + i});
        newest[part] = first + count - 1;
    }
    if (read.done_ > read.steps_.size()) return {};
    return read;
}

}  // namespace burin::document
