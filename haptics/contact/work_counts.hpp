// SPDX-License-Identifier: MIT
// Counts of the work that a tick does on contact, and what it may spend; what the work costs is said in
// haptics/contact/contact_work.hpp. Counts do not depend on the machine. Plain data.
#pragma once

#include <cstdint>

namespace burin::haptics {

struct ContactWork {
    std::uint32_t triangles_tested = 0;  // exact distance or sweep computations
    std::uint32_t triangles_seen = 0;    // checked by their bounding box or ball; a quad or four points count as one
    std::uint32_t gathered = 0;          // triangles kept by broad phases
    std::uint32_t points = 0;            // likewise
    std::uint32_t fours_measured = 0;    // times that the distances of four triangles were computed
    std::uint32_t steps = 0;             // of proxies
    std::uint32_t plane_solves = 0;
    std::uint32_t supports = 0;       // corners of a tool's piece searched for the farthest, so many times
    std::uint32_t pieces = 0;         // of triangles, given to samples of the tool's surface
    std::uint32_t cutting_terms = 0;  // elements of the tool's surface times iterations

    ContactWork& operator+=(const ContactWork& other) noexcept {
        triangles_tested += other.triangles_tested;
        triangles_seen += other.triangles_seen;
        gathered += other.gathered;
        points += other.points;
        fours_measured += other.fours_measured;
        steps += other.steps;
        plane_solves += other.plane_solves;
        supports += other.supports;
        pieces += other.pieces;
        cutting_terms += other.cutting_terms;
        return *this;
    }
};

// What a tick may spend on contact.
struct WorkSettings {
    double share = 1.0 / 3.0;  // of the loop's period
    double pace = 1.0;         // time that this machine takes over the reference core's
};

}  // namespace burin::haptics
