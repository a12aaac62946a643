// SPDX-License-Identifier: MIT
#include "study/report/study_sections.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "base/text.hpp"
#include "study/people/trial_rows.hpp"
#include "study/replay/stage_replay.hpp"
#include "study/report/study_figures.hpp"
#include "study/report/trial_figures.hpp"

namespace burin::study {
namespace {

constexpr std::size_t kMostSentences = 40;

bool is_outcome_trial(const Protocol& protocol, const StageVisit& visit) {
    const Stage* stage = protocol.stage(visit.stage);
    return stage != nullptr && stage->outcome && visit.status == StageStatus::ended;
}

ReportSection flow_of(const StudyFolder& study, const TrialRows& trials) {
    const std::vector<FlowOfGroup> groups = flow_of_groups(study, trials);
    ReportSection section{"Flow of participants", {}, {flow_figure(groups)}};
    const std::size_t outcomes = outcome_trials(study.protocol());
    for (const FlowOfGroup& g : groups)
        section.sentences.push_back(formatted(
            "Group %s: of %zu allocated %zu withdrew, %zu have stages left and no valid outcome trial, %zu went "
            "through "
            "all stages without one, and %zu are analysed: %zu with all %zu outcome trials of the protocol, %zu with "
            "some of them.",
            g.group.c_str(), g.allocated, g.withdrew, g.unfinished, g.without_valid_trial, g.analysed(), g.with_all,
            outcomes, g.with_some));
    return section;
}

std::string listed(const std::map<std::string, std::size_t>& reasons) {
    std::string text;
    const char* between = " (";
    for (const auto& [why, times] : reasons) {
        text += between + formatted("%s %zu", why.c_str(), times);
        between = ", ";
    }
    return reasons.empty() ? text : text + ")";
}

// Why attempts failed, by group: a task that nobody can do shows here first. What the operator or the device
// interrupted is told beside it, and is no failure of a participant.
ReportSection failures_of(const StudyFolder& study) {
    ReportSection section{"Failed attempts", {}, {}};
    for (const Group& group : study.protocol().groups) {
        std::size_t trials = 0, failed = 0, interrupted = 0, never_begun = 0;
        std::map<std::string, std::size_t> of_person, of_others;
        for (const Participant& p : study.participants()) {
            if (p.group != group.code || p.withdrawn) continue;
            for (const StageVisit& v : p.visits) {
                const Stage* stage = study.protocol().stage(v.stage);
                const bool trial = stage != nullptr && stage->kind == StageKind::trial;
                trials += trial && v.status == StageStatus::ended ? 1 : 0;
                const FailureCounts counts = failure_counts(v);
                failed += counts.of_person;
                interrupted += counts.of_operator_or_device;
                never_begun += counts.never_begun ? 1 : 0;
                for (const auto& [why, times] : v.failures)
                    if (const auto failure = failure_named(why))
                        (is_of_person(*failure) ? of_person : of_others)[why] += times;
            }
        }
        std::string sentence =
            formatted("Group %s: %zu failed attempts in %zu trials", group.code.c_str(), failed, trials) +
            listed(of_person);
        if (interrupted > 0)
            sentence += formatted("; %zu more attempts were interrupted by the operator or the device", interrupted) +
                        listed(of_others);
        if (never_begun > 0) sentence += formatted("; in %zu trials nobody came into the start cap", never_begun);
        section.sentences.push_back(sentence + ".");
    }
    return section;
}

bool deviations_differ(const Json& record) {
    const auto differ = record.find("deviations_differ");
    return differ != record.end() && differ->is_number() && differ->get<double>() != 0.0;
}

struct StageDeviation {
    std::string sentence;      // empty: none
    bool is_of_proxy = false;  // the proxy could not follow the hand: many trials share this one
};

// Of one stage as it was gone through.
StageDeviation deviation_of(const StudyFolder& study, const Participant& p, const StageVisit& v) {
    const std::string which = formatted("%s, %s (day %zu, stage %zu)", p.id.c_str(), v.stage.c_str(), v.day, v.place);
    if (v.status == StageStatus::aborted) return {which + ": interrupted; what was recorded until then is kept."};
    if (!is_outcome_trial(study.protocol(), v)) return {};
    if (v.file.empty() && v.result == name_of(StageResult::stopped)) return {};  // is told as a deviation
    if (v.file.empty() && v.result == name_of(StageResult::time_over))
        return {which + ": no valid exit in the time there was."};
    if (v.file.empty()) return {which + ": no valid exit after all attempts."};
    const auto record = study.recorded(v);
    if (!record) return {which + ": its file is missing or damaged, and is left out."};
    return deviations_differ(*record) ? StageDeviation{which, true} : StageDeviation{};
}

std::string joined_trials(const std::vector<std::string>& trials) {
    std::string text = formatted(
        "Deviation to the proxy and to the wall differ by more than %g mm in %zu trial%s, as the hand left the tube "
        "where "
        "the proxy could not follow; these have no figures of contact and force: ",
        kDeviationsAgree_mm, trials.size(), trials.size() == 1 ? "" : "s");
    for (std::size_t i = 0; i < trials.size(); ++i) text += (i > 0 ? "; " : "") + trials[i];
    return text + ".";
}

ReportSection deviations_of(const StudyFolder& study) {
    ReportSection section{"Deviations from the protocol", {}, {}};
    std::vector<std::string> of_proxy;
    std::size_t more = 0;
    for (const Participant& p : study.participants()) {
        if (!p.withdrawn)
            for (const ProtocolDeviation& d : p.deviations)
                section.sentences.push_back(p.id + ": " + d.text + " (" + d.utc + ").");
        for (const StageVisit& v : p.visits) {
            StageDeviation one = p.withdrawn ? StageDeviation{} : deviation_of(study, p, v);
            if (one.sentence.empty()) continue;
            if (one.is_of_proxy) {
                of_proxy.push_back(std::move(one.sentence));
            } else if (section.sentences.size() < kMostSentences) {
                section.sentences.push_back(std::move(one.sentence));
            } else {
                ++more;
            }
        }
    }
    if (more > 0) section.sentences.push_back(formatted("%zu more are not listed.", more));
    if (!of_proxy.empty()) section.sentences.push_back(joined_trials(of_proxy));
    if (section.sentences.empty()) section.sentences.emplace_back("None.");
    return section;
}

struct SampleTrial {
    std::string person;
    StageVisit visit;
    double deviation_mm = 0.0;
    bool differs = false;  // the proxy of the model hangs where the hand is not
};

// The trial of the group whose deviation is the middle one, of those whose motion is there and, where there are such,
// whose proxy followed the hand.
std::optional<SampleTrial> sample_of(const StudyFolder& study, const std::string& group) {
    std::vector<SampleTrial> trials;
    for (const Participant& p : study.participants()) {
        if (p.group != group || p.withdrawn) continue;
        for (const StageVisit& v : p.visits) {
            if (!is_outcome_trial(study.protocol(), v) || v.file.empty() || v.recording.empty()) continue;
            const auto record = study.recorded(v);
            if (record) trials.push_back({p.id, v, record->value("deviation_mm", 0.0), deviations_differ(*record)});
        }
    }
    if (trials.empty()) return std::nullopt;
    if (!std::ranges::all_of(trials, &SampleTrial::differs)) std::erase_if(trials, &SampleTrial::differs);
    std::ranges::stable_sort(trials, {}, &SampleTrial::deviation_mm);
    return trials[(trials.size() - 1) / 2];
}

ReportSection trial_section(const StudyFolder& study, const std::string& group) {
    ReportSection section{"A trial of group " + group, {}, {}};
    const auto sample = sample_of(study, group);
    if (!sample) {
        section.sentences.emplace_back("No motion of a valid trial was recorded.");
        return section;
    }
    const StudyWorld* world = study.protocol().world(study.protocol().stage(sample->visit.stage)->world);
    const auto felt = FeltWorld::create(*world);
    const std::filesystem::path file = study.path() / sample->visit.recording;
    auto replay = felt ? replay_stage(file, study.protocol(), study.facts().protocol_digest, **felt)
                       : Result<StageReplay>(std::unexpected(felt.error()));
    if (!replay) {
        section.sentences.push_back(replay.error().line());
        return section;
    }
    section.sentences.push_back(formatted(
        "%s, %s on day %zu: the trial with the middle deviation, %.3g mm, of the group's trials%s. Its motion was "
        "replayed "
        "through the haptic model with the tube's wall at %g N/m; deviations are point less collision point, forces "
        "those "
        "that the wall would have given each point. No force of the tube acted in the trial itself.",
        sample->person.c_str(), sample->visit.stage.c_str(), sample->visit.day, sample->deviation_mm,
        sample->differs ? "" : " in which the model's proxies followed the hand", world->wall_N_per_m));
    if (sample->differs)
        section.sentences.emplace_back(
            "The model's proxy could not follow the hand, in this as in all trials of the group whose motion is there: "
            "deviation and force of its points say nothing of the wall from there on.");
    if (replay->difference)
        section.sentences.push_back("The replay does not give what was stored: " + replay->difference->line());
    section.figures = trial_figures({group + ": " + sample->person, std::move(replay->model), &(*felt)->world()});
    return section;
}

}  // namespace

std::vector<ReportSection> report_sections(const StudyFolder& study) {
    std::vector<ReportSection> sections{flow_of(study, trial_rows(study)), failures_of(study), deviations_of(study)};
    for (const Group& group : study.protocol().groups) sections.push_back(trial_section(study, group.code));
    return sections;
}

}  // namespace burin::study
