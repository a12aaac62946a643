// SPDX-License-Identifier: MIT
// What the hands of a session touch: the carved workpiece, the objects of a world, the service of both, and what they
// report. Makes the orders that the scene's thread carries out, by the hands' own numbers.
// Threads: opened and asked by the frame's; orders are carried out, and collect() is called, by the scene's.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "document/document_writer.hpp"
#include "scene/scene_thread.hpp"
#include "session/hands/session_hands.hpp"
#include "session/live/sample_tap.hpp"
#include "session/live/scene_news.hpp"
#include "session/live/session_watch.hpp"
#include "session/live/world_side.hpp"
#include "workpiece/carve_order.hpp"

namespace burin::compute {
class CarvingEngine;  // compute/engine/engine.hpp
class Surface;        // compute/mesher/surface.hpp
}  // namespace burin::compute

namespace burin::workpiece {
class Workpiece;      // workpiece/workpiece.hpp
class WorkpiecePart;  // workpiece/workpiece.hpp
}  // namespace burin::workpiece

namespace burin::session {

class SceneSide {
public:
    // The stylus' second button takes hold of an object.
    static constexpr std::uint32_t kGrips = 2;
    using Order = scene::SceneThread::Order;
    using Give = std::function<void(Order)>;

    // The hands must outlive it.
    explicit SceneSide(SessionHands& hands);
    ~SceneSide();

    // Takes what is there to be touched, before begin().
    void take(std::unique_ptr<workpiece::Workpiece> workpiece);
    void take(std::unique_ptr<WorldSide> world) { world_ = std::move(world); }
    // How a hand begins, by the numbers of the scene.
    struct Beginning {
        Vec3 at_scene{0.0};
        double reach_m = 0.0;   // how far it may move until the next update
        double spread_m = 0.0;  // of its points, from the first
    };
    // Makes the scene of all hands, which begin with one tool, and updates it for the first time. brought: a part that
    // an activity brings, which must outlive this; tap: what the activity listens by. Null: none.
    [[nodiscard]] Result<void> begin(const workpiece::UseTool& use, std::size_t undo_bytes,
                                     std::span<const Beginning> hands, scene::ScenePart* brought, SampleTap* tap,
                                     Nanoseconds start_ns);

    // Orders for the scene's thread. A tool is the one of the hand in use.
    [[nodiscard]] Order carving(workpiece::CarveOrder order, std::size_t hand);
    // Has a part go a step back or forward; one that there is not says nothing.
    [[nodiscard]] Order going(std::uint32_t part, scene::StepWay way);
    // Adds the pages of the workpiece, before those of the request, and of what an activity has brought, behind them,
    // and has all saved; where that cannot be, nothing is.
    [[nodiscard]] Order saving(document::SaveRequest request, document::DocumentWriter& writer);
    // Notes a change for the journal, in its turn among the saves.
    [[nodiscard]] Order noting(document::Change change, document::DocumentWriter& writer);
    // Returns how many changes have been ordered so and are not noted yet.
    [[nodiscard]] std::int64_t to_be_noted() const { return to_be_noted_.load(std::memory_order_relaxed); }
    // Has a journal begin anew with the workpiece as it is then, before what is in the content, unless a stroke goes
    // on.
    [[nodiscard]] Order journalling(document::Content content, document::DocumentWriter& writer);
    // Has what is new of the part that an activity has brought noted, as the part of this number in the document,
    // unless a step of it goes on; is_due is false once it is.
    [[nodiscard]] Order noting_brought(std::int64_t place, document::History history, document::DocumentWriter& writer,
                                       std::shared_ptr<std::atomic<bool>> is_due);
    [[nodiscard]] Order editing(WorldOrder order);
    [[nodiscard]] Order holding(HoldOrder order);
    // Has what is known around a hand's first point reach its others, at this distance, where that is new.
    void spread(std::size_t hand, double spread_m, const Give& give);

    // How far the strokes on the workpiece have come, as of the last update that a frame has taken.
    struct Strokes {
        std::size_t undoable = 0, redoable = 0;
        std::uint64_t state = 0;  // compute::History::state
        bool exporting = false;
    };
    void note(const scene::SurfaceUpdate& update) {
        strokes_ = {update.undoable, update.redoable, update.state, update.exporting};
    }
    [[nodiscard]] const Strokes& strokes() const { return strokes_; }
    // Has the workpiece lit anew where it has turned under its lamp, and rests (LampWatch).
    void light(const SessionState& state, bool turns, Nanoseconds time_ns, const Give& give);

    [[nodiscard]] scene::SceneService& service() { return *service_; }
    [[nodiscard]] SceneNews& news() { return news_; }
    [[nodiscard]] const SceneNews& news() const { return news_; }
    // Null: there is no workpiece, or no world. The engine counts after the threads have ended.
    [[nodiscard]] const workpiece::Workpiece* workpiece() const { return workpiece_.get(); }
    [[nodiscard]] const compute::CarvingEngine* engine() const;
    // Returns the surface as it is carved now, and the objects of the world as they are now.
    [[nodiscard]] const compute::Surface* surface() const;
    [[nodiscard]] const scene::MeshPart* objects() const { return world_ ? &std::as_const(*world_).part() : nullptr; }
    [[nodiscard]] workpiece::WorkpiecePart* carved() { return carved_; }
    // The part that an activity has brought, null: none; and its number, behind workpiece and objects.
    [[nodiscard]] scene::ScenePart* brought() { return brought_; }
    [[nodiscard]] std::uint32_t brought_part() const { return (carved_ != nullptr ? 1u : 0u) + (world_ ? 1u : 0u); }
    [[nodiscard]] WorldSide* world() { return world_.get(); }
    [[nodiscard]] const WorldSide* world() const { return world_.get(); }
    // Of the workpiece's lattice; 0 without one.
    [[nodiscard]] double spacing_m() const;
    [[nodiscard]] Vec3 lattice_origin_object() const;

private:
    void save_brought(document::SaveRequest& wanted);

    SessionHands& hands_;
    std::unique_ptr<workpiece::Workpiece> workpiece_;  // null: there is none
    workpiece::WorkpiecePart* carved_ = nullptr;       // once it has begun
    std::unique_ptr<WorldSide> world_;
    std::vector<scene::ScenePart*> parts_;
    scene::ScenePart* brought_ = nullptr;
    std::optional<scene::SceneService> service_;
    SceneNews news_;
    Strokes strokes_;
    LampWatch lamp_;
    std::vector<double> spreads_m_;  // of each hand, as the scene's thread has been told
    std::atomic<std::int64_t> to_be_noted_ = 0;
    std::vector<double> tools_around_m_;  // of each hand's tool; the scene's thread's
};

}  // namespace burin::session
