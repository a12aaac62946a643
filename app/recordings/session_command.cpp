// SPDX-License-Identifier: MIT
#include "app/recordings/session_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <string>

#include "app/cli/output_files.hpp"
#include "app/recordings/session_words.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "record/compare.hpp"
#include "record/examination.hpp"
#include "record/store_reading.hpp"

namespace burin::app {
namespace {

Json hand_json(const record::HandRecord& hand, const record::HandSummary& summary) {
    Json json{{"name", hand.name}, {"ticks", summary.ticks}, {"blocks", hand.blocks.size()}};
    json["first_tick"] = summary.first_tick;
    json["gaps"] = Json::array();
    for (const record::TickGap& gap : summary.gaps)
        json["gaps"].push_back({{"until_tick", gap.after_tick}, {"missing", gap.missing}});
    json["objects"] = Json::array();
    for (const record::RecordedObject& object : hand.objects)
        json["objects"].push_back({{"number", object.number}, {"name", object.name}});
    json["columns"] = Json::array();
    for (const record::Column& column : hand.columns)
        json["columns"].push_back({{"name", column.name},
                                   {"unit", column.unit},
                                   {"frame", column.frame},
                                   {"type", std::string(record::name_of(column.type))}});
    return json;
}

// A fact of several lines, such as a wand's description, is counted: --json has it whole.
std::string shown_fact(const std::string& value) {
    const auto lines = static_cast<std::uint64_t>(std::ranges::count(value, '\n'));
    return lines > 0 ? counted(lines, "line", "lines") + " of text" : value;
}

void print_hand(const record::HandRecord& hand, const record::HandSummary& summary) {
    std::printf("%s: %s from tick %lld in %s, %s\n", hand.name.c_str(), counted(summary.ticks, "tick", "ticks").c_str(),
                static_cast<long long>(summary.first_tick), counted(hand.blocks.size(), "block", "blocks").c_str(),
                counted(summary.gaps.size(), "gap", "gaps").c_str());
    for (const record::TickGap& gap : summary.gaps)
        std::printf("  until tick %lld: %lld missing\n", static_cast<long long>(gap.after_tick),
                    static_cast<long long>(gap.missing));
    for (const record::RecordedObject& object : hand.objects)
        std::printf("  object %lld: %s\n", static_cast<long long>(object.number), object.name.c_str());
    for (const record::Column& column : hand.columns)
        std::printf("  %-34s %-9s %-7s %s\n", column.name.c_str(), column.unit.c_str(), column.frame.c_str(),
                    std::string(record::name_of(column.type)).c_str());
}

Result<void> session_info(const std::string& path, const std::string& json_path) {
    BURIN_TRY_DO(check_places(std::array{json_path}, std::array{path}));
    BURIN_TRY(reader, record::RecordReader::open(path));
    const auto trials = reader.trials();
    const auto clocks = reader.clocks();
    const auto lines = reader.lines();
    if (!trials) return std::unexpected(trials.error());
    if (!clocks) return std::unexpected(clocks.error());
    if (!lines) return std::unexpected(lines.error());
    BURIN_TRY(digest, reader.last_digest());
    const double moved_s = seconds(record::wall_clock_moved_ns(*clocks));
    Json json{{"file", path}, {"closed", reader.is_closed()}};
    json["last_digest"] = digest;
    json["facts"] = Json::object();
    for (const auto& [key, value] : reader.facts()) json["facts"][key] = value;
    json["lines"] = *lines;
    json["trials"] = Json::array();
    for (const record::TrialRecord& trial : *trials)
        json["trials"].push_back({{"name", trial.name}, {"state", trial.state}});
    json["wall_clock_moved_s"] = moved_s;
    json["hands"] = Json::array();
    for (const record::HandRecord& hand : reader.hands())
        json["hands"].push_back(hand_json(hand, record::summary_of(hand)));
    json["derived"] = Json::array();
    for (const record::HandRecord& table : reader.derived()) {
        json["derived"].push_back(hand_json(table, record::summary_of(table)));
        json["derived"].back()["program"] = table.program;
    }
    if (json_path != kStandardOutput) {
        std::printf("%s: %s\n", path.c_str(),
                    reader.is_closed() ? "a session" : "a session that was not closed: what was acknowledged is here");
        for (const auto& [key, value] : reader.facts())
            std::printf("  %-22s %s\n", key.c_str(), shown_fact(value).c_str());
        std::printf("  %-22s %s, %s; the wall clock moved by %g s against the monotonic one\n", "lines, trials, clock",
                    counted(*lines, "line", "lines").c_str(), counted(trials->size(), "trial", "trials").c_str(),
                    moved_s);
        if (!digest.empty())
            std::printf("  %-22s %s (noted elsewhere, it shows a cut end)\n", "last digest", digest.c_str());
        for (const record::HandRecord& hand : reader.hands()) print_hand(hand, record::summary_of(hand));
        for (const record::HandRecord& table : reader.derived()) {
            std::printf("derived by %s: ", table.program.c_str());
            print_hand(table, record::summary_of(table));
        }
    }
    return write_output(json_path, json_text(json));
}

// Ticks that the loop could not run are no damage of the file, but of what it is a record of.
void print_ticks_due(const record::HandExamination& found, const std::string& name) {
    if (!found.never_run || found.ticks == 0) return;
    std::printf("%s: %llu of %llu due ticks never ran; the longest time between two ticks is %.3g ms\n", name.c_str(),
                static_cast<unsigned long long>(*found.never_run),
                static_cast<unsigned long long>(found.ticks + *found.never_run),
                1e3 * seconds(found.longest_interval_ns));
}

// Prints what the chain of digests shows. Returns how many places it names.
Result<std::size_t> check_chain(record::RecordReader& reader) {
    BURIN_TRY(chain, reader.examine_chain());
    const char* file = reader.path().c_str();
    if (!chain.is_there) {
        std::printf(
            "%s: has no chain of digests, since an earlier version wrote it: what was changed later stays unseen\n",
            file);
        return std::size_t{0};
    }
    for (const std::string& fault : chain.faults) std::printf("%s: %s\n", file, fault.c_str());
    std::printf("%s: %s chained, %s; the last digest is %s\n", file,
                counted(static_cast<std::uint64_t>(chain.links), "transaction", "transactions").c_str(),
                counted(chain.faults.size(), "place is", "places are").append(" other than recorded").c_str(),
                chain.last_digest.c_str());
    return chain.faults.size();
}

Result<void> check_session(const std::string& path) {
    BURIN_TRY(reader, record::RecordReader::open(path));
    BURIN_TRY(structure, reader.structure_fault());
    std::size_t damaged = structure.empty() ? 0 : 1;
    std::vector<std::string_view> empty;  // tables without ticks
    if (!structure.empty()) std::printf("%s: %s\n", path.c_str(), structure.c_str());
    for (std::size_t h = 0; h < reader.tables(); ++h) {
        const record::HandExamination found = record::examine(reader, h);
        for (const Error& error : found.damaged) std::printf("%s\n", error.line().c_str());
        for (const record::TickGap& gap : found.gaps)
            std::printf("%s: after tick %lld: %lld missing\n", reader.table(h).name.c_str(),
                        static_cast<long long>(gap.after_tick), static_cast<long long>(gap.missing));
        std::printf("%s: %s read, %s damaged, %s, %s that run backwards, %s that are no numbers\n",
                    reader.table(h).name.c_str(), counted(found.ticks, "tick", "ticks").c_str(),
                    counted(found.damaged.size(), "block", "blocks").c_str(),
                    counted(found.gaps.size(), "gap", "gaps").c_str(),
                    counted(found.backward_times, "time", "times").c_str(),
                    counted(found.not_finite, "value", "values").c_str());
        print_ticks_due(found, reader.table(h).name);
        damaged += found.damaged.size();
        if (found.ticks == 0 && found.damaged.empty()) empty.push_back(reader.table(h).name);
    }
    BURIN_TRY(changed, check_chain(reader));
    if (!reader.is_closed()) std::printf("%s: was not closed; ticks of the last second may be missing\n", path.c_str());
    if (record::lacks_its_log(path))
        return fail(path, "has no log " + path + "-wal beside it: what was recorded last is missing",
                    "put the log, with which the file was left, beside it again");
    if (damaged == 0 && changed > 0 && empty.empty()) {
        std::fflush(stdout);
        return fail(path, "is not as it was recorded: " + counted(changed, "place was", "places were") + " changed",
                    "take the file as it was recorded, from a copy");
    }
    if (damaged == 0 && empty.empty() && !reader.hands().empty()) return {};
    std::fflush(stdout);
    if (damaged == 0)
        return fail(path, "holds no ticks" + (empty.empty() ? std::string() : " of " + joined(empty)),
                    "nothing was recorded, it was killed within its first second, or its blocks are gone");
    return fail(path, counted(damaged, "part is", "parts are") + " damaged", "the rest can be read and converted");
}

Result<void> compare_sessions(const std::string& a, const std::string& b, const std::string& columns) {
    Result<record::RecordReader> first = record::RecordReader::open(a), second = record::RecordReader::open(b);
    if (!first) return std::unexpected(first.error());
    if (!second) return std::unexpected(second.error());
    BURIN_TRY(found, record::compare(*first, *second, columns));
    if (found.ticks == 0 && !found.difference)
        return fail(b, "holds no ticks, nor does " + a, "compare recordings of something");
    if (found.difference)
        return fail(b, "differs from " + a + " after " + counted(found.ticks, "equal tick", "equal ticks") + ": " +
                           found.difference->line());
    std::printf("%s, %s: equal to the bit\n", counted(found.ticks, "tick", "ticks").c_str(),
                counted(found.columns, "column", "columns").c_str());
    return {};
}

struct AskedInfo {
    std::string file, json;
};

CommandAction add_session_info(Command command) {
    const auto options = std::make_shared<AskedInfo>();
    command.option("FILE", options->file, "A file that --record has written").required();
    command.option("--json", options->json, "A file for all of it; - for standard output");
    return action([options] { return session_info(options->file, options->json); });
}

CommandAction add_session_check(Command command) {
    const auto file = std::make_shared<std::string>();
    command.option("FILE", *file, "A file that --record has written").required();
    return action([file] { return check_session(*file); });
}

struct AskedComparison {
    std::string first, second, columns;
};

CommandAction add_session_compare(Command command) {
    const auto options = std::make_shared<AskedComparison>();
    command.option("A", options->first, "A file that --record has written").required();
    command.option("B", options->second, "Another").required();
    command.option("--columns", options->columns,
                   "Names with commas between them, a star at the end for all that begin so; else all");
    return action([options] { return compare_sessions(options->first, options->second, options->columns); });
}

CommandAction add_session(Command command) {
    command.require_subcommand();
    return add_commands(
        command,
        {{"info", "What is in a session file: columns with units and frames, ticks, gaps, clocks", add_session_info},
         {"check", "Read all of a session file and name what is damaged or was changed; exit status 1 then",
          add_session_check},
         {"compare", "The first difference of two session files; exit status 1 where there is one",
          add_session_compare}});
}

}  // namespace

CommandRow session_row() { return {"session", "Session files: recorded ticks", add_session}; }

}  // namespace burin::app
