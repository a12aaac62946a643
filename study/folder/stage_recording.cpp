// SPDX-License-Identifier: MIT
#include "study/folder/stage_recording.hpp"

#include <algorithm>
#include <iterator>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/motion.hpp"
#include "record/touched_columns.hpp"

namespace burin::study {
namespace {

// Simulated time has no clock that holds it back: the writer takes what there is after so many ticks.
constexpr std::size_t kTakenTogether = 2048;

constexpr const char* kRecordedHand = "wand";

// The wand's description, for whoever feels the motion elsewhere (docs/formats.md, "Replaying").
std::vector<std::pair<std::string, std::string>> facts_of_wand(const devices::WandDescription& wand) {
    std::string text = formatted("name = \"%s\"\n", kRecordedHand), points;
    for (const devices::WandPoint& point : wand.points) {
        const Vec3& p = point.offset_m;
        text +=
            formatted("[[point]]\nname = \"%s\"\noffset = [%.17g, %.17g, %.17g]\n", point.name.c_str(), p.x, p.y, p.z);
        points += (points.empty() ? "" : ",") + point.name;
    }
    return {{record::kWandTextFact, text}, {record::kWandDigestFact, sha256(text)}, {record::kWandPointsFact, points}};
}

}  // namespace

std::vector<record::Word> stage_row(const haptics::TickRecord& tick, const record::RowShape& shape) {
    std::vector<record::Word> row = record::row_of(tick, shape);
    record::append_touched(tick, shape, row);
    return row;
}

StageRecording::StageRecording() : ring_(2 * kTakenTogether) {}
StageRecording::~StageRecording() = default;

Result<std::unique_ptr<StageRecording>> StageRecording::create(const std::filesystem::path& file,
                                                               const StageTouch& touch,
                                                               std::vector<std::pair<std::string, std::string>> facts,
                                                               Nanoseconds block_ns) {
    std::unique_ptr<StageRecording> made(new StageRecording());
    record::WriterOptions options;
    options.facts = std::move(facts);
    options.block_ns = block_ns;
    options.objects = {{kTubeObject, "tube"}, {kStartFunnelObject, "start funnel"}, {kEndFunnelObject, "end funnel"}};
    const auto stage = std::ranges::find(options.facts, kStageFact, [](const auto& fact) { return fact.first; });
    if (stage != options.facts.end()) made->stage_ = stage->second;
    const record::RowShape shape = record::shape_of(touch.device(), touch.parameters().probe);
    record::RecordedHand hand{kRecordedHand, touch.device(), touch.parameters().probe, &made->ring_};
    hand.more_columns = record::touched_columns(shape);
    hand.more_values = [shape](const haptics::TickRecord& tick, std::vector<record::Word>& row) {
        record::append_touched(tick, shape, row);
    };
    std::vector<record::RecordedHand> hands;
    hands.push_back(std::move(hand));
    BURIN_TRY(writer, record::RecordWriter::create(file.string(), std::move(hands), std::move(options)));
    made->writer_ = std::move(writer);
    return made;
}

void StageRecording::note_trials(const StageSession& session) {
    for (const TrialMark& mark : marks_.take(session)) {
        if (mark.begins)
            trial_ = writer_->begin_trial(mark.time_ns, stage_);
        else if (trial_)
            writer_->end_trial(*std::exchange(trial_, std::nullopt), mark.time_ns, mark.state);
    }
}

void StageRecording::take(const haptics::TickRecord& record, OperatorAct act, const StageSession& session) {
    note_trials(session);
    if (act != OperatorAct::none) writer_->note_event(record.time_ns, kOperatorEvent, name_of(act));
    ring_.push(record);
    if (++untaken_ < kTakenTogether) return;
    writer_->take_now();
    untaken_ = 0;
}

void StageRecording::note(Nanoseconds time_ns, const std::string& name, const std::string& value) {
    writer_->note_event(time_ns, name, value);
}

Result<void> StageRecording::close() { return writer_->close(); }

std::vector<std::pair<std::string, std::string>> facts_of_stage(const std::string& protocol_digest, const Group& group,
                                                                const Stage& stage, const FeltWorld& world,
                                                                const StageTouch& touch) {
    const haptics::TickParameters& p = touch.parameters();
    std::vector<std::pair<std::string, std::string>> facts{
        {kProtocolFact, protocol_digest},
        {kWorldFact, world.digest()},
        {kGroupFact, group.code},
        {kStageFact, stage.name},
        {"tube", formatted("%.17g N/m, %.17g Ns/m", p.materials[kTubeMaterial].stiffness_N_per_m,
                           p.materials[kTubeMaterial].damping_Ns_per_m)},
        {"funnels", formatted("%.17g N/m, %.17g Ns/m", p.materials[kFunnelMaterial].stiffness_N_per_m,
                              p.materials[kFunnelMaterial].damping_Ns_per_m)},
        {"force limit", formatted("%.17g N", p.limits.max_force_N)},
        {"led by the device", touch.leads() ? "yes" : "no"}};
    std::ranges::move(facts_of_wand(touch.wand()), std::back_inserter(facts));
    return facts;
}

std::vector<std::pair<std::string, std::string>> facts_of_hand(const std::string& participant, const HeldDevice& held) {
    return {{"participant", participant},
            {"device", held.device},
            {"hand", name_of(held.hand)},
            {"felt by a person", held.felt_by_person() ? "yes" : "no"}};
}

}  // namespace burin::study
