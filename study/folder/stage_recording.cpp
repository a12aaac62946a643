// SPDX-License-Identifier: MIT
#include "study/folder/stage_recording.hpp"

#include <algorithm>
#include <iterator>

#include "base/sha256.hpp"
#include "base/text.hpp"
#include "record/motion.hpp"

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
    auto writer = record::RecordWriter::create(
        file.string(), {{kRecordedHand, touch.device(), touch.parameters().probe, &made->ring_}}, std::move(options));
    if (!writer) return std::unexpected(writer.error());
    made->writer_ = std::move(*writer);
    return made;
}

void StageRecording::take(const haptics::TickRecord& record, OperatorAct act) {
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
        {"device", touch.device().name},
        {"tube", formatted("%.17g N/m, %.17g Ns/m", p.materials[kTubeMaterial].stiffness_N_per_m,
                           p.materials[kTubeMaterial].damping_Ns_per_m)},
        {"funnels", formatted("%.17g N/m, %.17g Ns/m", p.materials[kFunnelMaterial].stiffness_N_per_m,
                              p.materials[kFunnelMaterial].damping_Ns_per_m)},
        {"force limit", formatted("%.17g N", p.limits.max_force_N)},
        {"led by the device", touch.leads() ? "yes" : "no"}};
    std::ranges::move(facts_of_wand(touch.wand()), std::back_inserter(facts));
    return facts;
}

}  // namespace burin::study
