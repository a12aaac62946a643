// SPDX-License-Identifier: MIT
// The carving side of a session: carves what the hand does, carries out orders, and reports changes to the frame.
//
// Data flow of an update: stroke samples from the haptic thread -> sweeps (StrokeReader) -> Sculpture::update -> the
// local surface around the tool, published to the haptic thread -> light of a few tiles. Orders come from keys, panel,
// script or recording. take_surface_update() gives the frame the tiles that changed since the last call, as references
// to tiles that never change again.
// Frame: object, metres. Thread: one at a time, a SculptThread's or, where time is simulated, the caller's. An export
// works on copies on a thread of its own.
#pragma once

#include <cstddef>
#include <future>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "sculpt/finishing.hpp"
#include "sculpt/sculpture.hpp"
#include "sculpt/stroke_reader.hpp"

namespace burin::sculpt {

struct UseTool {
    Tool tool;                    // its material's index is looked up when the order is carried out
    geometry::Material material;  // added to the solid's table if it is new
    double hardness_Ns_per_m3 = 0.0;
};
struct UndoStroke {};
struct RedoStroke {};
struct ExportSurface {
    std::string path;    // .stl, .ply or .obj
    std::string name{};  // what the message calls it; empty: its path
    LengthUnit unit = LengthUnit::m;
    std::size_t asked_by = 0;        // comes back with the outcome; whoever gives the order knows what it means
    std::optional<Error> refused{};  // why nothing is written; carving takes the same course as if it were
};
struct LightFrom {
    compute::Lamp lamp_object;
};
using SculptOrder = std::variant<UseTool, UndoStroke, RedoStroke, ExportSurface, LightFrom>;

struct TileUpdate {
    std::uint32_t tile = 0;
    std::shared_ptr<const geometry::SurfaceTile> surface;  // null where no surface is left
    std::shared_ptr<const compute::TileLight> light;       // of the tile's vertices; null means full light
};

// Tells how an export has ended.
struct ExportOutcome {
    std::string message;  // for the user
    std::string path;
    std::size_t asked_by = 0;
    bool written = false, replaced = false;  // replaced: there was a file
};

// Changes since the previous surface update.
struct SurfaceUpdate {
    std::vector<TileUpdate> tiles;
    std::vector<Box> inner_boxes_object;  // boxes that now lie wholly inside the material
    Nanoseconds cut_ns = 0;               // time at which the tool worked last
    std::size_t undoable = 0, redoable = 0;
    bool exporting = false;              // an export is under way
    std::vector<std::string> messages;   // for the user
    std::vector<ExportOutcome> exports;  // that have ended, for the user as well
};

// Inputs of an update besides the orders before it; with them a recording can repeat the update.
struct UpdateSeen {
    Nanoseconds time_ns = 0;
    std::uint64_t last_tick = 0;  // tick of the last stroke sample that it read
    std::size_t orders = 0;       // orders carried out just before it; counted by whoever gives them
    bool export_ended = false;    // it was the first to find the export complete
    friend bool operator==(const UpdateSeen&, const UpdateSeen&) = default;
};

class SculptService {
public:
    // Tiles baked in one update: few while the tool works, more while it rests.
    static constexpr std::size_t kLitWorking = 4, kLitResting = 16;

    // sculpture and channels must outlive the service. `reach_m` is how far the tool may move until the next update.
    // With `undo_bytes` the service has the sculpture keep a history within that much memory, and passes its notices
    // on; without, a history that the sculpture keeps remains the caller's affair.
    SculptService(Sculpture& sculpture, haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3,
                  double reach_m, std::optional<std::size_t> undo_bytes);
    ~SculptService();

    // Sets where the tool is before the first sample.
    void start_at(const Vec3& position_object) { reader_.start_at(position_object); }
    // Carries out an order. One that fails leaves the solid as it was and a message in the next surface update.
    void order(const SculptOrder& order);
    // Carves what the hand has done since the last update, and publishes the surface around the tool. Each release of
    // the button ends a stroke, which is what one undo takes back. Fails when the engine does; the solid is then as it
    // was before the update. `recorded` limits the update to the samples that a recorded one read, and has it wait for
    // an export that the recorded one found complete.
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const UpdateSeen* recorded = nullptr);
    [[nodiscard]] Result<void> repeat(const UpdateSeen& recorded) { return update(recorded.time_ns, &recorded); }
    // Returns the inputs of the last update; `orders` is 0 unless it was given.
    [[nodiscard]] const UpdateSeen& seen() const { return seen_; }
    // Returns nullopt when nothing has changed.
    [[nodiscard]] std::optional<SurfaceUpdate> take_surface_update();
    // Waits for the export under way, if any.
    void finish_export();
    // Returns the number of local surfaces published so far.
    [[nodiscard]] std::uint64_t published() const { return sequence_; }

private:
    void carry_out(const UseTool& use);
    void carry_out(const UndoStroke&);
    void carry_out(const RedoStroke&);
    void carry_out(const ExportSurface& wanted);
    void carry_out(const LightFrom& from);
    void drop_invalid(std::vector<compute::ToolSweep>& sweeps);
    void notify(std::string message);
    [[nodiscard]] bool export_is_done() const;
    [[nodiscard]] Result<void> publish(Nanoseconds now_ns);

    Sculpture& sculpture_;
    haptics::HapticChannels& channels_;
    StrokeReader reader_;
    double reach_m_;
    bool keeps_history_;
    std::uint64_t sequence_ = 0;  // of the last local surface
    bool stroke_open_ = false;    // the button was down at the end of the last update
    bool status_changed_ = true;  // something other than tiles and messages has to be reported
    std::future<ExportOutcome> export_;
    std::optional<Error> refused_;  // why the tool that was asked for last cannot carve; nothing does until another
    bool said_why_ = false;         // this stroke's user has been told why nothing is carved
    std::vector<std::string> messages_;
    std::vector<ExportOutcome> exports_;  // that have ended and nobody knows of
    UpdateSeen seen_;
};

}  // namespace burin::sculpt
