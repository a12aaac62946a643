// SPDX-License-Identifier: MIT
// The carving side of a session: carves what the hand does, carries out orders, and reports changes to the frame.
//
// Data flow of an update: stroke samples from the haptic thread -> sweeps (StrokeReader) -> Sculpture::update -> the
// local surface around the tool, published to the haptic thread -> light of a few tiles. Orders come from keys, panel,
// script or recording. take_surface_update() gives the frame the tiles that changed since the last call, as references
// to tiles that never change again.
// Several hands, each with a haptic loop, channels and a tool of its own, work on one sculpture. What they do is carved
// in the order of the samples' times, ties by the hand's number, and depends neither on when samples come nor on when
// updates are: slice by slice of tick time, each when all hands have written their samples of it. Where two hands work
// at one place, the later one wins. A hand that has written nothing for kPatience_ns is not waited for; what it writes
// late is carved when it comes, counted and told. Each hand's strokes are undone alone, the one that ended last first;
// those that met are one (compute/rays/history.hpp, docs/decisions/024-two-hands.md). One hand waits for nobody, and
// has no slices.
// Frame: object, metres. Thread: one at a time, a SculptThread's or, where time is simulated, the caller's. An export
// works on copies on a thread of its own.
#pragma once

#include <array>
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
    std::size_t hand = 0;  // whose tool it becomes
};
struct UndoStroke {};
struct RedoStroke {};
struct ExportSurface {
    std::string path;  // .stl, .ply or .obj
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

// Changes since the previous surface update.
struct SurfaceUpdate {
    std::vector<TileUpdate> tiles;
    std::vector<Box> inner_boxes_object;  // boxes that now lie wholly inside the material
    Nanoseconds cut_ns = 0;               // time at which the tool worked last
    std::size_t undoable = 0, redoable = 0;
    bool exporting = false;             // an export is under way
    std::vector<std::string> messages;  // for the user
};

inline constexpr std::size_t kMostHands = 4;  // at one sculpture

// Inputs of an update besides the orders before it; with them a recording can repeat the update.
struct UpdateSeen {
    Nanoseconds time_ns = 0;
    std::uint64_t last_tick = 0;  // tick of the last stroke sample that it took of the first hand
    std::size_t orders = 0;       // orders carried out just before it; counted by whoever gives them
    bool export_ended = false;    // it was the first to find the export complete
    std::array<std::uint64_t, kMostHands - 1> other_ticks{};  // of the other hands, as last_tick
    bool last = false;                                        // nothing comes after it: no hand was waited for
    friend bool operator==(const UpdateSeen&, const UpdateSeen&) = default;
};

class SculptService {
public:
    // Tiles baked in one update: few while the tool works, more while it rests.
    static constexpr std::size_t kLitWorking = 4, kLitResting = 16;
    // Several hands: the tick time within which samples are merged into sweeps, and how long a hand that writes no
    // samples is waited for, which is some ticks of a resting loop.
    static constexpr Nanoseconds kSlice_ns = 5'000'000, kPatience_ns = 100'000'000;

    // sculpture and channels must outlive the service. `reach_m` is how far the tool may move until the next update.
    // With `undo_bytes` the service has the sculpture keep a history within that much memory, and passes its notices
    // on; without, a history that the sculpture keeps remains the caller's affair.
    SculptService(Sculpture& sculpture, haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3,
                  double reach_m, std::optional<std::size_t> undo_bytes);
    ~SculptService();

    // Adds a hand, whose channels must outlive the service, and returns its number; the first has 0. At most
    // kMostHands, before the first update.
    std::size_t add_hand(haptics::HapticChannels& channels, const Tool& tool, double hardness_Ns_per_m3);
    // Sets where a hand's tool is before the first sample.
    void start_at(const Vec3& position_object, std::size_t hand = 0) { hands_[hand].reader.start_at(position_object); }
    // Carries out an order, between the samples carved so far and those that have not been. One that fails leaves the
    // solid as it was and a message in the next surface update.
    void order(const SculptOrder& order);
    // Carves what the hand has done since the last update, and publishes the surface around the tool. Each release of
    // the button ends a stroke, which is what one undo takes back. Fails when the engine does; the solid is then as it
    // was before the update. `recorded` limits the update to the samples that a recorded one read, and has it wait for
    // an export that the recorded one found complete.
    [[nodiscard]] Result<void> update(Nanoseconds now_ns, const UpdateSeen* recorded = nullptr);
    [[nodiscard]] Result<void> repeat(const UpdateSeen& recorded) { return update(recorded.time_ns, &recorded); }
    // The last update, after the haptic loops have ended: waits for no hand.
    [[nodiscard]] Result<void> finish(Nanoseconds now_ns);
    // Returns the inputs of the last update; `orders` is 0 unless it was given.
    [[nodiscard]] const UpdateSeen& seen() const { return seen_; }
    // Returns nullopt when nothing has changed.
    [[nodiscard]] std::optional<SurfaceUpdate> take_surface_update();
    // Waits for the export under way, if any.
    void finish_export();
    // Returns the number of local surfaces published so far to each hand.
    [[nodiscard]] std::uint64_t published() const { return sequence_; }
    // Returns the number of a hand's samples that came after the others of their time had been carved.
    [[nodiscard]] std::uint64_t late_samples(std::size_t hand) const { return hands_[hand].late_samples; }

private:
    void carry_out(const UseTool& use);
    void carry_out(const UndoStroke&);
    void carry_out(const RedoStroke&);
    void carry_out(const ExportSurface& wanted);
    void carry_out(const LightFrom& from);
    struct Hand {
        haptics::HapticChannels& channels;
        StrokeReader reader;
        // Why the tool that was asked for last cannot carve; nothing does until another.
        std::optional<Error> refused = {};
        bool said_why = false;   // this stroke's user has been told why nothing is carved
        bool said_late = false;  // likewise, that samples came late
        std::uint64_t late_samples = 0;
    };
    // Sweeps of a hand in a piece of tick time.
    struct Worked {
        std::size_t hand = 0;
        SweptSamples swept;
    };

    [[nodiscard]] Result<void> update_seen(const UpdateSeen* recorded);
    void take_samples(const UpdateSeen* recorded);
    [[nodiscard]] Result<void> carve();
    [[nodiscard]] Result<void> carve_slice(Nanoseconds end_ns);
    [[nodiscard]] Result<void> carve_piece(Nanoseconds end_ns);
    [[nodiscard]] Result<void> carve_merged(const std::vector<Worked>& worked);
    [[nodiscard]] std::optional<Nanoseconds> oldest_ns() const;
    [[nodiscard]] Nanoseconds complete_ns() const;
    [[nodiscard]] Nanoseconds first_release_ns(Nanoseconds before_ns) const;
    [[nodiscard]] bool hands_meet(Nanoseconds before_ns) const;
    void count_late(Hand& hand, const SweptSamples& swept);
    void drop_invalid(Hand& hand, SweptSamples& swept);
    void bake_light();
    void notify(std::string message);
    [[nodiscard]] bool export_is_done() const;
    [[nodiscard]] Result<void> publish(Hand& hand, Nanoseconds now_ns);

    Sculpture& sculpture_;
    std::vector<Hand> hands_;       // one or more
    Nanoseconds carved_to_ns_ = 0;  // end of the last slice that has been carved
    double reach_m_;
    bool keeps_history_;
    std::uint64_t sequence_ = 0;       // of the last local surface
    bool stroke_open_ = false;         // a button was down at the end of the last update
    bool status_changed_ = true;       // something other than tiles and messages has to be reported
    std::future<std::string> export_;  // gives the message for the user
    std::vector<std::string> messages_;
    UpdateSeen seen_;
};

}  // namespace burin::sculpt
