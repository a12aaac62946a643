// SPDX-License-Identifier: MIT
// The carving side of a live session: what is carved, undone, exported, and what the frame is told about it.
//
// Data flow: orders (from keys, panel or script) and stroke samples (from the haptic thread, by its channel) come in; update() carries
// out what the hand did since the last one, and hands the haptic thread the surface near the tool; take_news() gives the frame the tiles
// that changed, as references to what never changes again.
// Thread: one at a time: a CarvingThread's, or the caller's where time is simulated.
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "app/felt_carving.hpp"
#include "app/finishing.hpp"

namespace burin {

struct UseTool {
    Tool tool;  // its material's number is found here
    Material material;
    double hardness_Ns_per_m3 = 0.0;
};
struct UndoStroke {};
struct RedoStroke {};
struct ExportSurface {
    std::string path;  // .stl, .ply, .obj
};
struct LightFrom {  // the lamp, as seen from the workpiece
    Lamp lamp_object;
};
using CarvingOrder = std::variant<UseTool, UndoStroke, RedoStroke, ExportSurface, LightFrom>;

struct TileNews {
    std::uint32_t tile = 0;
    std::shared_ptr<const SurfaceTile> surface;  // null: nothing is left there
    std::shared_ptr<const TileLight> light;      // of its vertices; null: all there is
};

// What has happened since the last news.
struct SurfaceNews {
    std::vector<TileNews> tiles;
    std::vector<Box> inner_boxes_object;  // wholly inside the material, now
    Nanoseconds cut_ns = 0;               // when the tool worked last
    std::size_t undoable = 0, redoable = 0;
    std::optional<double> export_progress;  // 0 to 1, while one goes on
    std::vector<std::string> messages;      // for people
};

// What an update depended on besides the orders before it: enough to do the same again.
struct UpdateSeen {
    Nanoseconds time_ns = 0;
    std::uint64_t last_tick = 0;  // whose stroke sample it took
    std::size_t orders = 0;       // that were new to it; whoever gives them counts
    bool export_ended = false;    // it was the first to know
    friend bool operator==(const UpdateSeen&, const UpdateSeen&) = default;
};

class CarvingDesk {
public:
    // All must outlive it. Strokes are kept for undoing within the memory given.
    CarvingDesk(Carving& carving, HapticChannels& channels, WorkerPool& pool, const Tool& tool,
                double hardness_Ns_per_m3, double reach_m, std::size_t undo_bytes);
    ~CarvingDesk();

    void start_at(const Vec3& position_object) { side_.start_at(position_object); }
    // What cannot be done is said in a message; the solid is then as before.
    void order(const CarvingOrder& order);
    // Fails when the engine does: the solid is then as before the update.
    [[nodiscard]] Result<void> update(Nanoseconds now_ns);
    // The same update again: takes the samples that it took, and waits for an export that it knew to have ended.
    [[nodiscard]] Result<void> repeat(const UpdateSeen& seen);
    // What the last update depended on, but for the orders.
    [[nodiscard]] const UpdateSeen& seen() const { return seen_; }
    // Nothing when nothing has happened.
    [[nodiscard]] std::optional<SurfaceNews> take_news();
    // Waits for an export that goes on.
    void finish_export();

private:
    void carry_out(const UseTool& use);
    void carry_out(const UndoStroke&);
    void carry_out(const RedoStroke&);
    void carry_out(const ExportSurface& wanted);
    void carry_out(const LightFrom& from);
    void say(std::string message);
    [[nodiscard]] bool export_is_done() const;
    [[nodiscard]] Result<void> carve(Nanoseconds now_ns, std::uint64_t last_tick);

    Carving& carving_;
    WorkerPool& pool_;
    CarvingSide side_;
    bool stroke_open_ = false;
    bool republish_ = false;           // the surface changed other than by the hand
    std::future<std::string> export_;  // what to say about it
    std::vector<std::string> messages_;
    bool anything_ = true;  // to be told, besides tiles
    UpdateSeen seen_;
};

}  // namespace burin
