// SPDX-License-Identifier: MIT
// What a ball touches where it is, and how far it may go: the god-object's questions to the surface, each with its work
// counted against the tick's budget.
//
// Tolerances are fractions of the ball's radius; see haptics/contact/god_object.hpp. Frame: relative to the surface's origin,
// metres. No heap, lock, throw.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "haptics/contact/candidates.hpp"
#include "haptics/contact/god_object.hpp"
#include "haptics/contact/half_spaces.hpp"
#include "haptics/contact/room.hpp"

namespace burin {

inline constexpr double kTouch = 1e-3;
inline constexpr double kTie = 1e-6;  // two triangles share their nearest point: an edge or a corner

// The half-spaces, relative to the ball's centre, of the triangles that it touches from outside.
struct Touches {
    static constexpr std::uint32_t kMost = 1024;  // a ball lying in its own groove touches about 100 facets

    struct Place {
        Vec3 point{0.0};  // of the triangle, nearest to the centre
        std::uint32_t candidate = 0;
        bool on_face = false;  // inside the triangle; else on an edge or a corner
    };
    Room<HalfSpace, kMost> planes;
    Room<Place, kMost> places;
    std::uint32_t count = 0;

    [[nodiscard]] std::span<const HalfSpace> span() const { return planes.first(count); }
};

struct Nearest {
    double distance = HUGE_VAL;
    double height = 0.0;  // above the triangle's plane; negative: behind it
    Vec3 point{0.0};
    Vec3 normal{0.0};
};

// One tick's questions for a ball of one radius.
class ContactSearch {
public:
    ContactSearch(const LocalSurface& surface, double radius, const ProxyBudget& budget, ProxyWork& work) noexcept
        : surface_(surface), radius_(radius), budget_(budget), work_(work) {}

    // Makes known what the ball may touch on the way and a little beside it. If there is no room for so much, a shorter way
    // from its beginning. False when the tick's work is used up.
    [[nodiscard]] bool look_along(const Way& way) noexcept;
    [[nodiscard]] bool knows(const Vec3& center) const noexcept { return candidates_.covers(center); }
    // The share of the way from a known centre that stays within what is known.
    [[nodiscard]] double known_share(const Vec3& center, const Vec3& motion) const noexcept;

    struct Touching {
        Nearest nearest;  // of all triangles within reach, whichever side they turn
        bool complete = true;
    };
    // At a known centre.
    [[nodiscard]] Touching touching(const Vec3& center, Touches& touches) noexcept;

    struct Sweep {
        double fraction = 1.0;
        bool complete = true;
    };
    // How far the ball may go, all triangles considered but those that touch already: of the last touching(). Both ends known.
    [[nodiscard]] Sweep sweep(const Vec3& center, const Vec3& motion) noexcept;

    // The nearest triangle of all, by boxes that double until what they found must be it. Of those that are farther than
    // `most` any or none; none too when the work is used up. Knows nothing of what look_along found.
    [[nodiscard]] Nearest nearest(const Vec3& center, double most) noexcept;

    // Whether the surface within reach shows its back to the centre on the whole: by the solid angles that its triangles take up, so
    // that a facet folded over, as a surface under carving may have, is outvoted by those around it. False when the tick's work
    // is used up.
    [[nodiscard]] bool sees_backs(const Vec3& center, double reach) noexcept;

    [[nodiscard]] const Candidates& candidates() const noexcept { return candidates_; }

private:
    [[nodiscard]] bool count_test() noexcept {
        if (work_.triangles_tested >= budget_.max_triangles_tested) return false;
        ++work_.triangles_tested;
        return true;
    }
    void keep_nearest(Nearest& best, const Nearest& other) const noexcept;

    const LocalSurface& surface_;
    double radius_;
    ProxyBudget budget_;
    ProxyWork& work_;
    int looks_taken_ = 0;
    Candidates candidates_;
    Room<bool, Candidates::kMost> touches_already_;  // of those below candidates_.count()
};

}  // namespace burin
