// SPDX-License-Identifier: MIT
// The smallest activity that draws, to be copied: docs/first-activity.md leads through it. While the stylus' button is
// down its tip leaves a bead every few millimetres. A slider says how far apart they are, which `do apart METRES` says
// too, and `do clear` takes all of them away. It is compiled and tested with the others, and is no part of the program.
// Frame: the scene's, metres. Thread: the frame's.
#pragma once

#include <array>
#include <cstdint>
#include <cstdio>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/text.hpp"
#include "picture/drawn_mesh.hpp"
#include "picture/picture.hpp"
#include "session/activity/activity.hpp"
#include "session/record/session_check.hpp"

namespace burin::activities {

class Trail final : public session::Activity {
public:
    static constexpr std::size_t kMostBeads = 1000;  // a picture of more is slow on a software driver
    static constexpr double kLeastApart_m = 0.0001, kMostApart_m = 1.0;
    explicit Trail(double apart_m) : begun_apart_m_(apart_m), apart_m_(apart_m) {}

    // A recording keeps this line, and makes the activity anew of it alone, as it was in the beginning: it has the acts
    // that came later among its commands.
    [[nodiscard]] std::string settings() const override { return formatted("trail --apart %.17g", begun_apart_m_); }
    [[nodiscard]] static Result<std::shared_ptr<Trail>> of_settings(const std::string& settings) {
        double apart_m = 0.0;
        if (std::sscanf(settings.c_str(), "trail --apart %lf", &apart_m) == 1 && apart_m >= kLeastApart_m)
            if (auto trail = std::make_shared<Trail>(apart_m); trail->settings() == settings) return trail;
        return fail(settings, "are no settings of a trail", "replay it with the program that recorded it");
    }

    [[nodiscard]] std::span<const session::Act> acts() const override {
        static constexpr std::array kTrailActs{session::Act{"apart",
                                                            "METRES",
                                                            "Lay beads so far apart from now on",
                                                            {session::number_within(kLeastApart_m, kMostApart_m, "m")}},
                                               session::Act{"clear", "", "Take all beads away"}};
        return kTrailActs;
    }
    // The words are of the kinds above: a number in its range, or nothing.
    Result<void> act(std::span<const std::string> words, session::ActivityOrders& /*orders*/) override {
        if (words[0] == "apart") {
            apart_m_ = session::number_of(words[1]);
            return {};
        }
        if (beads_scene_m_.empty()) return fail("command do clear", "nothing is drawn", "draw with the button down");
        beads_scene_m_.clear();
        return {};
    }

    // Places come from ticks and never from frames, so that a slow picture draws the same trail.
    void step(const session::ActivityView& view, session::ActivityOrders& orders) override {
        for (const haptics::TickRecord& tick : view.first_part().ticks) {
            if ((tick.sample.buttons & 1u) == 0) continue;
            const Vec3& tip_scene_m = tick.contact.points[0].proxy_object_m;
            if (!beads_scene_m_.empty() && glm::distance(tip_scene_m, beads_scene_m_.back()) < apart_m_) continue;
            if (beads_scene_m_.size() < kMostBeads)
                beads_scene_m_.push_back(tip_scene_m);
            else if (!std::exchange(told_full_, true))
                orders.messages.emplace_back("the trail is full; Clear begins another");
        }
        if (beads_scene_m_.size() < kMostBeads) told_full_ = false;
    }
    [[nodiscard]] std::uint64_t check() const override {
        session::CheckSum sum;
        sum.add(apart_m_);
        for (const Vec3& bead_scene_m : beads_scene_m_) sum.add(bead_scene_m);
        return sum.sum();
    }

    void stage(picture::Picture& scene, std::size_t /*screen*/) const override {
        static const std::shared_ptr<const picture::DrawnMesh> kBead = picture::drawn_mesh(octahedron(), {});
        for (const Vec3& bead_scene_m : beads_scene_m_)
            scene.objects.push_back({.mesh = kBead,
                                     .world_from_mesh = scene.world_from_object *
                                                        Similarity{bead_scene_m, Quat{1, 0, 0, 0}, 0.3 * apart_m_},
                                     .colour = {0.1, 0.4, 0.8}});
    }
    // Its widgets, in the order in which they stand. Each gives words of acts().
    [[nodiscard]] session::ActivityPanel panel() const override {
        using Panel = session::ActivityPanel;
        return {.title = "Trail",
                .aside = std::to_string(beads_scene_m_.size()),
                .page = "Hold the button down and draw.",
                .widgets = {Panel::Slider{.name = "Apart",
                                          .value = apart_m_,
                                          .from = 0.001,
                                          .to = 0.02,
                                          .step = 0.0005,
                                          .unit = "mm",
                                          .units_in_one = 1000.0,
                                          .act = {"apart"}},
                            Panel::Button{"Clear", {"clear"}, !beads_scene_m_.empty()}}};
    }

private:
    // Of radius 1.
    static geometry::TriangleMesh octahedron() {
        geometry::TriangleMesh mesh;
        mesh.positions_m = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
        mesh.triangles = {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}};
        return mesh;
    }

    double begun_apart_m_, apart_m_;
    std::vector<Vec3> beads_scene_m_;
    bool told_full_ = false;
};

}  // namespace burin::activities
