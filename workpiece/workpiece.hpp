// SPDX-License-Identifier: MIT
// A workpiece as a session has it: made, begun as a part of the scene, given orders, saved. Who carves it, and how, is
// behind this: sculpt/carved_workpiece.hpp is the one that Burin has.
//
//   WorkpieceMaker  -> Workpiece      before the scene: read, checked, converted, meshed
//   Workpiece::begin -> WorkpiecePart  the part of the scene that hands carve
//
// Frame: object, metres; a workpiece stands in the scene as in its own frame.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "base/error.hpp"
#include "compute/engine/engine.hpp"
#include "compute/engine/history.hpp"
#include "compute/mesher/surface.hpp"
#include "scene/scene_part.hpp"
#include "scene/surface_update.hpp"
#include "workpiece/carve_order.hpp"
#include "workpiece/loaded_workpiece.hpp"

namespace burin::workpiece {

// Thread: one at a time, that of the scene's service.
class WorkpiecePart : public scene::ScenePart {
public:
    // Tells what has changed, as pages (workpiece/saved_changes.hpp), when a stroke ends, when one is undone, and from
    // time to time meanwhile. Before the first update.
    using TakeChange = std::function<void(scene::Pages)>;
    virtual void keep_journal(TakeChange take) = 0;
    // Returns which state the work is in (compute::History::state); 0 without a history.
    [[nodiscard]] virtual std::uint64_t state() const = 0;
    // Puts all of the solid into the pages, after the journal was told of what it holds. Returns false, and does
    // nothing, while a stroke goes on.
    [[nodiscard]] virtual bool copy(scene::Pages& pages) = 0;

    // Carries out an order. One that fails leaves the solid as it was and a message in the next surface update. A hand
    // comes after the cursor: undo and redo that are asked for while a button is still down wait for the stroke's end,
    // for a while, and so do an export and a save behind them.
    virtual void order(const CarveOrder& order) = 0;
    // Gives a hand a tool, likewise.
    virtual void order(const UseTool& use, std::size_t hand) = 0;
    // Returns the radius of a ball about a hand's tool that holds the tool and what the tick looks at around it.
    [[nodiscard]] virtual double around_m(std::size_t hand) const = 0;

    // Returns nullopt when nothing has changed.
    [[nodiscard]] virtual std::optional<scene::SurfaceUpdate> take_surface_update() = 0;
};

// Thread: the frame's, until a scene's thread has its part.
class Workpiece {
public:
    Workpiece() = default;
    virtual ~Workpiece() = default;
    Workpiece(const Workpiece&) = delete;
    Workpiece& operator=(const Workpiece&) = delete;

    // Returns what it was loaded as; its solid is the engine's.
    [[nodiscard]] virtual const LoadedWorkpiece& loaded() const = 0;
    [[nodiscard]] virtual const compute::Surface& surface() const = 0;
    // Its counts are whole once the threads have ended.
    [[nodiscard]] virtual const compute::CarvingEngine& engine() const = 0;
    struct Work {
        std::uint64_t updates = 0, rays_changed = 0;
    };
    [[nodiscard]] virtual Work work() const = 0;
    // Puts all of the solid and the newest steps of its history into the pages, while no scene's thread has it.
    virtual void copy(scene::Pages& pages) const = 0;

    // Begins to be carved, once: by so many parts of hands, which all hold one tool. undo_bytes: the memory for its
    // history where it begins with none. What is returned lives as long as the workpiece.
    [[nodiscard]] virtual WorkpiecePart& begin(const UseTool& use, std::size_t undo_bytes, std::size_t parts) = 0;
};

// What of a document a workpiece goes on with.
struct EarlierWork {
    LoadedWorkpiece loaded;
    std::optional<compute::History> history = std::nullopt;
    bool is_saved = false;  // a document holds it as it is here
};

}  // namespace burin::workpiece
