// SPDX-License-Identifier: MIT
#include "desk/draw/presented_parts.hpp"

#include <algorithm>

namespace burin::session {
namespace {

constexpr std::size_t kMostImages = 8;  // per window; older images are drawn whole

bool overlap(const PixelRect& a, const PixelRect& b) {
    return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

// Adds a part and merges it with those that it overlaps.
void add(std::vector<PixelRect>& parts, PixelRect part) {
    for (auto other = parts.begin(); other != parts.end();) {
        if (!overlap(*other, part)) {
            ++other;
            continue;
        }
        part = around(part, *other);
        parts.erase(other);
        other = parts.begin();  // the merged part may overlap earlier ones
    }
    parts.push_back(part);
}

void merge(PresentedParts::Parts& into, const PresentedParts::Parts& other) {
    into.whole = into.whole || other.whole;
    for (const PixelRect& part : other.parts) add(into.parts, part);
}

}  // namespace

void PresentedParts::change(const PixelRect& part) {
    if (!part.empty()) add(pending_.parts, part);
}

void PresentedParts::change_all() { pending_.whole = true; }

PresentedParts::Parts PresentedParts::since(std::uint64_t age) const {
    Parts together = pending_;
    if (age == 0 || age > presented_.size()) together.whole = true;
    for (std::uint64_t i = 0; !together.whole && i + 1 < age; ++i) merge(together, presented_[i]);
    if (together.whole) together.parts.clear();
    return together;
}

void PresentedParts::presented() {
    presented_.push_front(pending_);
    if (presented_.size() > kMostImages) presented_.pop_back();
    pending_ = {.whole = false, .parts = {}};
}

}  // namespace burin::session
