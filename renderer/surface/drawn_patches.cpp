// SPDX-License-Identifier: MIT
#include "renderer/surface/drawn_patches.hpp"

#include <utility>

namespace burin::renderer {
namespace {

// A screen that draws nothing for a while, say in a minimised window, collects no more boxes than this.
constexpr std::size_t kMostBoxes = 4096;
constexpr std::size_t kWorthAPicture = 256;  // patches with new levels

}  // namespace

DrawnPatches::DrawnPatches(PatchStore& store) : store_(store), states_(store.slots()) { store_.enrol(*this); }

DrawnPatches::~DrawnPatches() { store_.leave(*this); }

DrawnPatches::Changes DrawnPatches::take_changes() { return std::exchange(changes_, {}); }

void DrawnPatches::slot_taken(std::uint32_t slot) {
    if (slot >= states_.size()) states_.resize(slot + 1);
    states_[slot] = {};
}

void DrawnPatches::all_removed(const Box& bounds) {
    states_.clear();
    add(bounds);
}

void DrawnPatches::appeared_or_vanished(const Box& bounds) { add(bounds); }

void DrawnPatches::changed(const Change& change) {
    State& state = of(change.now);
    if (std::exchange(state.level, std::uint8_t{0}) > 0) {
        add(change.was.shape.bounds);
        add(change.now.shape.bounds);
    } else {
        add(change.changed);
    }
    // A replaced patch keeps its rate and is wanted.
    if (change.replaced) state.wanted = true;
}

void DrawnPatches::levels_are_there(bool all_done) {
    if (new_levels_ >= kWorthAPicture || (all_done && new_levels_ > 0)) changes_.whole = true;
}

void DrawnPatches::add(const Box& box) {
    if (box.empty()) return;
    if (changes_.boxes.size() < kMostBoxes) {
        changes_.boxes.push_back(box);
    } else {
        changes_.whole = true;
    }
}

}  // namespace burin::renderer
