// SPDX-License-Identifier: MIT
#include "study/protocol/protocol.hpp"

#include <algorithm>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include "base/text.hpp"
#include "study/protocol/protocol_table.hpp"

namespace burin::study {
namespace {

constexpr std::array kStageKinds{std::pair{"page", StageKind::page}, std::pair{"show_model", StageKind::show_model},
                                 std::pair{"free_training", StageKind::free_training},
                                 std::pair{"led_training", StageKind::led_training},
                                 std::pair{"trial", StageKind::trial}};
constexpr double kLongestStage_s = 4.0 * 3600.0, kLongestDelay_h = 24.0 * 366.0;
constexpr unsigned kLargestBlock = 1000, kMostAttempts = 100, kLargestRatio = 100;
constexpr std::size_t kMostStrataCombinations = 1000;

// Reads the tables of a protocol and then checks what concerns several of them.
class ProtocolReader {
public:
    ParsedProtocol read(const toml::table& root) {
        ProtocolTable top(parsed_.faults, &root, "the protocol");
        double format = 0.0;
        top.require("format", "write format = 1 in its first line");
        top.number("format", format, 1.0, 1.0, "(the only format there is)");
        top.require("name", "write name = \"my-study\"");
        top.code("name", p_.name);
        top.text("title", p_.title);
        top.require("consent", "write the version of the consent document: consent = \"2026-11\"");
        top.code("consent", p_.consent_version);
        read_limits(top);
        for (const toml::table* t : top.tables("stratum")) read_stratum(*t);
        for (const toml::table* t : top.tables("group")) read_group(*t);
        for (const toml::table* t : top.tables("world")) read_world(*t);
        for (const toml::table* t : top.tables("stage")) read_stage(*t);
        read_allocation(top);
        for (const toml::table* t : top.tables("day")) read_day(*t);
        read_validity(top);
        read_analysis(top);
        check_presence(top);
        top.refuse_unknown();
        std::ranges::stable_sort(parsed_.faults, {},
                                 [](const ProtocolFault& f) { return std::pair(f.line, f.column); });
        return std::move(parsed_);
    }

private:
    ProtocolTable reader(const toml::table* table, const std::string& name) {
        return ProtocolTable(parsed_.faults, table, name);
    }

    void read_limits(ProtocolTable& top) {
        ProtocolTable t = reader(top.table("limits"), "[limits]");
        t.number("force_N", p_.force_limit_N, 0.0, kDeviceForce_N, "N, the most that the device displays");
        t.number("calibration_tolerance_m", p_.calibration_tolerance_m, 1e-5, 0.1, "m");
        t.number("resume_within_min", p_.resume_within_min, 0.0, 60.0 * 24.0, "min");
        t.number("guidance_N_per_m", p_.guidance_N_per_m, 0.0, 5000.0, "N/m");
        t.number("lead_m_per_s", p_.lead_m_per_s, 1e-3, 1.0, "m/s");
        t.number("point_offset_m", p_.point_offset_m, 1e-4, 1.0, "m");
        t.refuse_unknown();
    }

    void read_stratum(const toml::table& table) {
        ProtocolTable t = reader(&table, "[[stratum]]");
        Stratum s;
        t.require("name", "write name = \"hand\"");
        t.code("name", s.name);
        t.require("codes", "write codes = [\"l\", \"r\"]");
        t.codes("codes", s.codes);
        if (std::set(s.codes.begin(), s.codes.end()).size() != s.codes.size())
            t.refuse("codes", "names a code twice", "name each once");
        if (s.codes.size() == 1) t.refuse("codes", "has one code only", "name two or more, or leave the stratum out");
        unique(t, strata_, s.name, "stratum");
        t.refuse_unknown();
        p_.strata.push_back(std::move(s));
    }

    void read_group(const toml::table& table) {
        ProtocolTable t = reader(&table, "[[group]]");
        Group g;
        t.require("code", "write code = \"haptic\"");
        t.code("code", g.code);
        t.count("ratio", g.ratio, 1, kLargestRatio);
        t.flag("sees_tube", g.sees_tube);
        t.flag("feels_tube", g.feels_tube);
        unique(t, groups_, g.code, "group", "code");
        t.refuse_unknown();
        p_.groups.push_back(std::move(g));
    }

    void read_world(const toml::table& table) {
        ProtocolTable t = reader(&table, "[[world]]");
        StudyWorld w;
        for (const char* key : {"name", "spine_m", "tube_radius_m", "cap_half_width_m"})
            t.require(key, "see docs/study.md for what a world needs");
        t.code("name", w.name);
        t.points("spine_m", w.spine_m);
        t.number("tube_radius_m", w.tube_radius_m, 1e-3, 1.0, "m");
        t.number("cap_half_width_m", w.cap_half_width_m, 1e-3, 1.0, "m");
        t.number("cap_depth_m", w.cap_depth_m, 1e-3, 0.2, "m");
        t.number("funnel_half_width_m", w.funnel_half_width_m, 1e-3, 1.0, "m");
        t.number("wall_N_per_m", w.wall_N_per_m, 1.0, 5000.0, "N/m");
        t.number("wall_Ns_per_m", w.wall_Ns_per_m, 0.0, 100.0, "Ns/m");
        unique(t, worlds_, w.name, "world");
        check_world(t, w);
        t.refuse_unknown();
        p_.worlds.push_back(std::move(w));
    }

    // Both points have to fit through whatever they are to pass.
    void check_world(ProtocolTable& t, const StudyWorld& w) {
        const double need_m = p_.point_offset_m;
        if (w.tube_radius_m > 0.0 && w.tube_radius_m <= need_m)
            t.refuse("tube_radius_m",
                     formatted("is %g m, but a point lies %g m off the wand's middle", w.tube_radius_m, need_m),
                     "widen the tube or give a smaller point_offset_m: both points begin outside otherwise");
        if (w.cap_half_width_m > 0.0 && w.cap_half_width_m <= need_m)
            t.refuse("cap_half_width_m", "is too small for both points", formatted("write more than %g", need_m));
        if (w.funnel_half_width_m > 0.0 && w.funnel_half_width_m <= need_m)
            t.refuse("funnel_half_width_m", "is too narrow for both points", formatted("write more than %g", need_m));
        for (std::size_t i = 1; i < w.spine_m.size(); ++i) {
            if (glm::distance(w.spine_m[i - 1], w.spine_m[i]) > 1e-6) continue;
            t.refuse("spine_m", formatted("has points %zu and %zu in one place", i, i + 1), "take one of them out");
        }
        if (w.spine_m.size() > 1 &&
            glm::distance(w.spine_m.front(), w.spine_m.back()) < 2.0 * (w.cap_depth_m + w.cap_half_width_m))
            t.refuse("spine_m", "ends so near to its start that the caps may overlap",
                     "move the ends apart or make the caps smaller");
    }

    void read_stage(const toml::table& table) {
        ProtocolTable t = reader(&table, "[[stage]]");
        Stage s;
        t.require("name", "write name = \"test\"");
        t.code("name", s.name);
        t.require("kind", "write kind = \"trial\"");
        read_kind(t, s);
        t.code("world", s.world);
        t.text("text", s.page_text);
        if (t.has("ends_after_s")) {
            double seconds = 1.0;
            t.number("ends_after_s", seconds, 0.1, kLongestStage_s, "s");
            s.ends_after_s = seconds;
        }
        t.flag("ends_at_exit", s.ends_at_exit);
        t.flag("ends_by_operator", s.ends_by_operator);
        s.sees_world = s.feels_world = s.kind != StageKind::trial;
        t.flag("sees_world", s.sees_world);
        t.flag("feels_world", s.feels_world);
        t.flag("sees_wand", s.sees_wand);
        t.flag("records", s.records);
        t.count("attempts", s.attempts, 1, kMostAttempts);
        t.flag("outcome", s.outcome);
        t.number("guidance_first", s.guidance_first, -1.0, 1.0, "(below 0 it leads away: augmented error)");
        t.number("guidance_last", s.guidance_last, -1.0, 1.0, "(below 0 it leads away: augmented error)");
        check_stage(t, s);
        unique(t, stages_, s.name, "stage");
        t.refuse_unknown();
        p_.stages.push_back(std::move(s));
    }

    static void read_kind(ProtocolTable& t, Stage& s) {
        std::string kind;
        t.text("kind", kind);
        const auto* const found =
            std::ranges::find(kStageKinds, kind, [](const auto& k) { return std::string(k.first); });
        if (found != kStageKinds.end()) {
            s.kind = found->second;
        } else if (t.has("kind")) {
            t.refuse("kind", "is no kind of stage", "write page, show_model, free_training, led_training or trial");
        }
    }

    void check_stage(ProtocolTable& t, const Stage& s) {
        if (!s.ends_after_s && !s.ends_at_exit && !s.ends_by_operator)
            t.refuse("name", "has no end", "write ends_after_s, ends_at_exit = true or ends_by_operator = true");
        if (s.kind != StageKind::page && s.world.empty()) t.require("world", "name one of the worlds");
        if (!s.world.empty() && !worlds_.contains(s.world))
            t.refuse("world", "names no world", "name a [[world]] of this file");
        if (s.kind != StageKind::trial && s.ends_at_exit)
            t.refuse("ends_at_exit", "is for trials only", "take it out or write kind = \"trial\"");
        if (s.kind != StageKind::trial && s.outcome)
            t.refuse("outcome", "is for trials only", "take it out or write kind = \"trial\"");
        if (s.kind == StageKind::trial && !s.records)
            t.refuse("records", "is false for a trial", "take it out: a trial that is not recorded measures nothing");
    }

    void read_allocation(ProtocolTable& top) {
        ProtocolTable t = reader(top.table("allocation"), "[allocation]");
        const unsigned sum = std::accumulate(p_.groups.begin(), p_.groups.end(), 0u,
                                             [](unsigned all, const Group& g) { return all + g.ratio; });
        t.counts("blocks", p_.blocks, 1, kLargestBlock);
        for (const unsigned size : p_.blocks) {
            if (sum == 0 || size % sum == 0) continue;
            t.refuse("blocks", formatted("has %u, no multiple of the ratios' sum %u", size, sum),
                     formatted("write %u or %u", sum, 2 * sum));
        }
        if (p_.blocks.empty() && sum > 0) p_.blocks.push_back(2 * sum);
        t.refuse_unknown();
        std::size_t combinations = 1;
        for (const Stratum& s : p_.strata) {
            combinations *= std::max<std::size_t>(1, s.codes.size());
            if (combinations <= kMostStrataCombinations) continue;
            top.refuse("stratum", formatted("gives more than %zu combinations of codes", kMostStrataCombinations),
                       "balance by fewer properties");
            break;
        }
    }

    void read_day(const toml::table& table) {
        ProtocolTable t = reader(&table, "[[day]]");
        Day d;
        t.number("least_delay_h", d.least_delay_h, 0.0, kLongestDelay_h, "h");
        d.most_delay_h = d.least_delay_h;
        t.number("most_delay_h", d.most_delay_h, 0.0, kLongestDelay_h, "h");
        if (d.most_delay_h < d.least_delay_h) t.refuse("most_delay_h", "is below least_delay_h", "exchange the two");
        if (!p_.days.empty() && d.most_delay_h <= 0.0)
            t.require("most_delay_h", "say how long after the day before this one may be");
        t.require("stages", "write stages = [\"introduction\", \"test\"]");
        t.codes("stages", d.stages);
        for (const std::string& stage : d.stages) {
            if (!stages_.contains(stage))
                t.refuse("stages", "names " + stage + ", which is no stage", "name a [[stage]] of this file");
        }
        t.refuse_unknown();
        p_.days.push_back(std::move(d));
    }

    void read_validity(ProtocolTable& top) {
        ProtocolTable t = reader(top.table("validity"), "[validity]");
        Validity& v = p_.validity;
        std::string clock = p_.clock == ClockStart::leave ? "leave" : "touch";
        t.text("clock_starts", clock);
        if (clock != "leave" && clock != "touch")
            t.refuse("clock_starts", "is neither leave nor touch", "write \"leave\" or \"touch\"");
        p_.clock = clock == "touch" ? ClockStart::touch : ClockStart::leave;
        t.number("stray_m", v.stray_m, 0.01, 10.0, "m");
        t.number("still_s", v.still_s, 0.1, 3600.0, "s");
        t.number("still_m", v.still_m, 1e-5, 0.1, "m");
        t.number("longest_gap_s", v.longest_gap_s, 0.002, 10.0, "s");
        t.number("return_m", v.return_m, 1e-3, 10.0, "m");
        t.refuse_unknown();
    }

    void read_analysis(ProtocolTable& top) {
        ProtocolTable t = reader(top.table("analysis"), "[analysis]");
        t.text("primary_outcome", p_.primary_outcome);
        if (p_.primary_outcome != "deviation" && p_.primary_outcome != "time")
            t.refuse("primary_outcome", "is neither deviation nor time", "write one of the two");
        t.number("alpha", p_.alpha, 1e-6, 0.5, "");
        t.refuse_unknown();
    }

    void check_presence(ProtocolTable& top) {
        for (const char* key : {"group", "world", "stage", "day"})
            top.require(key, "write at least one [[" + std::string(key) + "]]");
        if (p_.groups.size() > 20) top.refuse("group", "comes more than 20 times", "compare fewer groups");
        const bool measured = std::ranges::any_of(p_.stages, &Stage::outcome);
        if (!p_.stages.empty() && !measured)
            top.refuse("stage", "has no outcome", "write outcome = true in the trials to be analysed");
    }

    void unique(ProtocolTable& t, std::set<std::string>& seen, const std::string& name, const std::string& what,
                const char* key = "name") {
        if (!name.empty() && !seen.insert(name).second)
            t.refuse(key, "is the name of another " + what + " too", "give each its own");
    }

    ParsedProtocol parsed_;
    Protocol& p_ = parsed_.protocol;
    std::set<std::string> strata_, groups_, worlds_, stages_;
};

}  // namespace

const char* name_of(StageKind kind) {
    return std::ranges::find(kStageKinds, kind, [](const auto& k) { return k.second; })->first;
}

const StudyWorld* Protocol::world(std::string_view named) const {
    const auto found = std::ranges::find(worlds, named, &StudyWorld::name);
    return found == worlds.end() ? nullptr : &*found;
}

const Stage* Protocol::stage(std::string_view named) const {
    const auto found = std::ranges::find(stages, named, &Stage::name);
    return found == stages.end() ? nullptr : &*found;
}

std::string line_of(const ProtocolFault& fault, const std::string& file) {
    return file + ":" + std::to_string(fault.line) + ":" + std::to_string(fault.column) + ": " + fault.what + "; " +
           fault.remedy;
}

ParsedProtocol parse_protocol(std::string_view text) {
    try {
        return ProtocolReader().read(toml::parse(text));
    } catch (const toml::parse_error& error) {
        ParsedProtocol broken;
        broken.faults.push_back({error.source().begin.line, error.source().begin.column,
                                 "is not TOML: " + std::string(error.description()), "correct this line"});
        return broken;
    }
}

}  // namespace burin::study
