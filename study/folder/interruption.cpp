// SPDX-License-Identifier: MIT
#include "study/folder/interruption.hpp"

#include <time.h>

#include <algorithm>
#include <cstdio>
#include <iterator>

#include "base/clock.hpp"
#include "base/text.hpp"
#include "record/record_reader.hpp"

namespace burin::study {
namespace {

// What a recording that was cut off holds; it may hold nothing yet.
void look_at_recording(Interruption& one, const std::filesystem::path& file) {
    if (one.visit.recording.empty()) return;
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    if (error) {
        one.unreadable = Error{"cannot be found", file.string(), "restore it from a copy"};
        return;
    }
    if (bytes == 0) return;  // it was cut off before its first transaction
    auto reader = record::RecordReader::open(file.string());
    if (!reader) one.unreadable = reader.error();
    if (!reader || reader->hands().empty()) return;
    one.ticks_kept = reader->hands().front().rows();
    const auto clocks = reader->clocks();
    if (clocks && !clocks->empty()) one.known_utc_ns = std::max(one.known_utc_ns, clocks->back().utc_ns);
}

std::vector<Interruption> of_person(const StudyFolder& study, const Participant& person) {
    std::vector<Interruption> all;
    if (person.withdrawn) return all;
    for (const StageVisit& visit : person.visits) {
        if (visit.status != StageStatus::aborted) continue;
        Interruption one{person.id,
                         visit,
                         0,
                         std::nullopt,
                         utc_of(visit.begun_utc),
                         person.has_ended(visit.day, visit.place)};
        look_at_recording(one, study.path() / visit.recording);
        all.push_back(std::move(one));
    }
    return all;
}

}  // namespace

std::vector<Interruption> interruptions_of(const StudyFolder& study) {
    std::vector<Interruption> all;
    for (const Participant& p : study.participants()) std::ranges::move(of_person(study, p), std::back_inserter(all));
    return all;
}

std::string Interruption::text() const {
    const std::string motion = visit.recording.empty() ? "its motion was not recorded"
                               : unreadable
                                   ? "its motion cannot be read (" + unreadable->line() + ")"
                                   : formatted("%llu ticks of its motion are kept",
                                               static_cast<unsigned long long>(ticks_kept));
    return formatted("%s, %s (day %zu, stage %zu), known until %s; ", participant.c_str(), visit.stage.c_str(),
                     visit.day, visit.place, utc_text(known_utc_ns).c_str()) +
           motion + (done_again ? "; done again" : "; to be done again");
}

std::string LateResumption::text(const Protocol& protocol) const {
    const StageVisit& v = interruption.visit;
    return formatted("%s (day %zu, stage %zu) was begun anew %.0f min after its interruption, and the protocol allows "
                     "%g min",
                     v.stage.c_str(), v.day, v.place, minutes, protocol.resume_within_min);
}

std::optional<LateResumption> late_resumption(const StudyFolder& study, const Participant& person,
                                              std::int64_t now_utc_ns) {
    const std::vector<Interruption> all = of_person(study, person);
    for (const Interruption& one : all) {
        const double minutes = static_cast<double>(now_utc_ns - one.known_utc_ns) * 1e-9 / 60.0;
        // Of several interruptions of one stage only the last counts.
        const auto later = [&](const Interruption& other) {
            return other.visit.day == one.visit.day && other.visit.place == one.visit.place &&
                   other.known_utc_ns > one.known_utc_ns;
        };
        if (one.done_again || minutes <= study.protocol().resume_within_min) continue;
        if (std::ranges::none_of(all, later)) return LateResumption{one, minutes};
    }
    return std::nullopt;
}

Result<void> check_resumption(const StudyFolder& study, const Participant& person, std::int64_t now_utc_ns) {
    const std::optional<LateResumption> late = late_resumption(study, person, now_utc_ns);
    if (!late) return {};
    return fail(person.id + ", " + late->interruption.visit.stage,
                formatted("was interrupted %.0f min ago, and the protocol lets a stage be taken up again within %g min",
                          late->minutes, study.protocol().resume_within_min),
                "give --resume to begin the stage anew all the same, which journal and report name as a deviation from "
                "the protocol, or withdraw the participant");
}

std::string utc_text(std::int64_t utc_ns) {
    const std::int64_t whole_s = utc_ns / kNanosecondsPerSecond;
    const auto time = static_cast<time_t>(whole_s);
    tm parts{};
    gmtime_r(&time, &parts);
    return formatted("%04d-%02d-%02dT%02d:%02d:%02d.%03dZ", parts.tm_year + 1900, parts.tm_mon + 1, parts.tm_mday,
                     parts.tm_hour, parts.tm_min, parts.tm_sec,
                     static_cast<int>((utc_ns - whole_s * kNanosecondsPerSecond) / 1'000'000));
}

std::int64_t utc_of(const std::string& text) {
    tm parts{};
    double second = 0.0;
    if (text.size() > 40 || std::sscanf(text.c_str(), "%4d-%2d-%2dT%2d:%2d:%lf", &parts.tm_year, &parts.tm_mon,
                                        &parts.tm_mday, &parts.tm_hour, &parts.tm_min, &second) != 6)
        return 0;
    if (!(second >= 0.0 && second < 62.0)) return 0;
    parts.tm_year -= 1900;
    parts.tm_mon -= 1;
    const time_t whole = timegm(&parts);
    return static_cast<std::int64_t>(whole) * kNanosecondsPerSecond + nanoseconds(second);
}

std::int64_t now_utc_ns() {
    timespec t{};
    clock_gettime(CLOCK_REALTIME, &t);
    return static_cast<std::int64_t>(t.tv_sec) * kNanosecondsPerSecond + t.tv_nsec;
}

DayVerdict day_verdict(const Protocol& protocol, std::size_t day, double hours_since) {
    if (day <= 1 || day > protocol.days.size()) return DayVerdict::in_time;
    const Day& d = protocol.days[day - 1];
    if (hours_since < d.least_delay_h) return DayVerdict::too_early;
    return hours_since > d.most_delay_h ? DayVerdict::too_late : DayVerdict::in_time;
}

}  // namespace burin::study
