// SPDX-License-Identifier: MIT
#include "app/recordings/session_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <filesystem>

#include "app/cli/output_files.hpp"
#include "base/text.hpp"
#include "record/compare.hpp"
#include "record/examination.hpp"
#include "record/export/new_file.hpp"
#include "record/export/table_export.hpp"
#include "record/store_reading.hpp"
#include "session/record/log_export.hpp"

namespace burin::app {
namespace {

std::string counted(std::uint64_t count, const char* one, const char* many) {
    return std::to_string(count) + " " + (count == 1 ? one : many);
}

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

Result<void> info(const std::string& path, const std::string& json_path) {
    if (const auto ok = check_places(std::array{json_path}, std::array{path}); !ok) return ok;
    Result<record::RecordReader> reader = record::RecordReader::open(path);
    if (!reader) return std::unexpected(reader.error());
    const auto trials = reader->trials();
    const auto clocks = reader->clocks();
    const auto lines = reader->lines();
    if (!trials) return std::unexpected(trials.error());
    if (!clocks) return std::unexpected(clocks.error());
    if (!lines) return std::unexpected(lines.error());
    const auto digest = reader->last_digest();
    if (!digest) return std::unexpected(digest.error());
    const double moved_s = seconds(record::wall_clock_moved_ns(*clocks));
    Json json{{"file", path}, {"closed", reader->is_closed()}};
    json["last_digest"] = *digest;
    json["facts"] = Json::object();
    for (const auto& [key, value] : reader->facts()) json["facts"][key] = value;
    json["lines"] = *lines;
    json["trials"] = Json::array();
    for (const record::TrialRecord& trial : *trials)
        json["trials"].push_back({{"name", trial.name}, {"state", trial.state}});
    json["wall_clock_moved_s"] = moved_s;
    json["hands"] = Json::array();
    for (const record::HandRecord& hand : reader->hands())
        json["hands"].push_back(hand_json(hand, record::summary_of(hand)));
    json["derived"] = Json::array();
    for (const record::HandRecord& table : reader->derived()) {
        json["derived"].push_back(hand_json(table, record::summary_of(table)));
        json["derived"].back()["program"] = table.program;
    }
    if (json_path != kStandardOutput) {
        std::printf("%s: %s\n", path.c_str(),
                    reader->is_closed() ? "a session" : "a session that was not closed: what was acknowledged is here");
        for (const auto& [key, value] : reader->facts())
            std::printf("  %-22s %s\n", key.c_str(), shown_fact(value).c_str());
        std::printf("  %-22s %s, %s; the wall clock moved by %g s against the monotonic one\n", "lines, trials, clock",
                    counted(*lines, "line", "lines").c_str(), counted(trials->size(), "trial", "trials").c_str(),
                    moved_s);
        if (!digest->empty())
            std::printf("  %-22s %s (noted elsewhere, it shows a cut end)\n", "last digest", digest->c_str());
        for (const record::HandRecord& hand : reader->hands()) print_hand(hand, record::summary_of(hand));
        for (const record::HandRecord& table : reader->derived()) {
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
    const Result<record::ChainExamination> chain = reader.examine_chain();
    if (!chain) return std::unexpected(chain.error());
    const char* file = reader.path().c_str();
    if (!chain->is_there) {
        std::printf(
            "%s: has no chain of digests, since an earlier version wrote it: what was changed later stays unseen\n",
            file);
        return std::size_t{0};
    }
    for (const std::string& fault : chain->faults) std::printf("%s: %s\n", file, fault.c_str());
    std::printf("%s: %s chained, %s; the last digest is %s\n", file,
                counted(static_cast<std::uint64_t>(chain->links), "transaction", "transactions").c_str(),
                counted(chain->faults.size(), "place is", "places are").append(" other than recorded").c_str(),
                chain->last_digest.c_str());
    return chain->faults.size();
}

Result<void> check(const std::string& path) {
    Result<record::RecordReader> reader = record::RecordReader::open(path);
    if (!reader) return std::unexpected(reader.error());
    const Result<std::string> structure = reader->structure_fault();
    if (!structure) return std::unexpected(structure.error());
    std::size_t damaged = structure->empty() ? 0 : 1;
    std::vector<std::string_view> empty;  // tables without ticks
    if (!structure->empty()) std::printf("%s: %s\n", path.c_str(), structure->c_str());
    for (std::size_t h = 0; h < reader->tables(); ++h) {
        const record::HandExamination found = record::examine(*reader, h);
        for (const Error& error : found.damaged) std::printf("%s\n", error.line().c_str());
        for (const record::TickGap& gap : found.gaps)
            std::printf("%s: after tick %lld: %lld missing\n", reader->table(h).name.c_str(),
                        static_cast<long long>(gap.after_tick), static_cast<long long>(gap.missing));
        std::printf("%s: %s read, %s damaged, %s, %s that run backwards, %s that are no numbers\n",
                    reader->table(h).name.c_str(), counted(found.ticks, "tick", "ticks").c_str(),
                    counted(found.damaged.size(), "block", "blocks").c_str(),
                    counted(found.gaps.size(), "gap", "gaps").c_str(),
                    counted(found.backward_times, "time", "times").c_str(),
                    counted(found.not_finite, "value", "values").c_str());
        print_ticks_due(found, reader->table(h).name);
        damaged += found.damaged.size();
        if (found.ticks == 0 && found.damaged.empty()) empty.push_back(reader->table(h).name);
    }
    const Result<std::size_t> changed = check_chain(*reader);
    if (!changed) return std::unexpected(changed.error());
    if (!reader->is_closed())
        std::printf("%s: was not closed; ticks of the last second may be missing\n", path.c_str());
    if (record::lacks_its_log(path))
        return fail(path, "has no log " + path + "-wal beside it: what was recorded last is missing",
                    "put the log, with which the file was left, beside it again");
    if (damaged == 0 && *changed > 0 && empty.empty()) {
        std::fflush(stdout);
        return fail(path, "is not as it was recorded: " + counted(*changed, "place was", "places were") + " changed",
                    "take the file as it was recorded, from a copy");
    }
    if (damaged == 0 && empty.empty() && !reader->hands().empty()) return {};
    std::fflush(stdout);
    if (damaged == 0)
        return fail(path, "holds no ticks" + (empty.empty() ? std::string() : " of " + joined(empty)),
                    "nothing was recorded, it was killed within its first second, or its blocks are gone");
    return fail(path, counted(damaged, "part is", "parts are") + " damaged", "the rest can be read and converted");
}

Result<void> compare(const std::string& a, const std::string& b, const std::string& columns) {
    Result<record::RecordReader> first = record::RecordReader::open(a), second = record::RecordReader::open(b);
    if (!first) return std::unexpected(first.error());
    if (!second) return std::unexpected(second.error());
    const Result<record::Comparison> found = record::compare(*first, *second, columns);
    if (!found) return std::unexpected(found.error());
    if (found->ticks == 0 && !found->difference)
        return fail(b, "holds no ticks, nor does " + a, "compare recordings of something");
    if (found->difference)
        return fail(b, "differs from " + a + " after " + counted(found->ticks, "equal tick", "equal ticks") + ": " +
                           found->difference->line());
    std::printf("%s, %s: equal to the bit\n", counted(found->ticks, "tick", "ticks").c_str(),
                counted(found->columns, "column", "columns").c_str());
    return {};
}

// Returns the table of this name: a hand, or a derived one by the beginning of its name.
Result<std::size_t> find_table(const record::RecordReader& reader, const std::string& part) {
    std::vector<std::string_view> names;
    std::vector<std::size_t> found;
    for (std::size_t t = 0; t < reader.tables(); ++t) {
        const record::HandRecord& table = reader.table(t);
        if (table.name == part) return t;
        if (!part.empty() && table.is_derived() && table.name.starts_with(part)) found.push_back(t);
        names.push_back(table.name);
    }
    if (part.empty() && reader.hands().size() == 1) return std::size_t{0};
    if (found.size() == 1) return found.front();
    const std::string what = part.empty()       ? "has several hands"
                             : found.size() > 1 ? "has several tables that begin with " + part
                                                : "has no hand or table " + part;
    return fail(reader.path(), what, "--part one of: " + joined(names));
}

// The name of the output where none is given: the recording's, with another ending.
std::string output_of(const ConvertOptions& options) {
    if (!options.out.empty()) return options.out;
    const std::filesystem::path in(options.in);
    if (options.to == "bids") return std::filesystem::path(in).replace_extension().string() + "-bids";
    return std::filesystem::path(in).replace_extension(options.to == "hdf5" ? "h5" : options.to).string();
}

Result<record::ExportReport> export_table(record::RecordReader& reader, const ConvertOptions& options,
                                          const std::string& out) {
    if (options.to == "log" && reader.facts().contains(record::kLogHeaderFact))
        return session::export_session_log(reader, out);
    if (options.to == "log") return record::export_log(reader, out);
    const Result<std::size_t> table = find_table(reader, options.part);
    if (!table) return std::unexpected(table.error());
    const auto columns = record::choose_columns(reader.table(*table).columns, options.columns);
    if (!columns) return std::unexpected(columns.error());
    Result<record::TickTimes> times;
    if (!options.trials.empty()) times = record::times_of_trials(reader, options.trials);
    if (!times) return std::unexpected(times.error());
    if (options.to == "npy") return record::export_npy(reader, *table, *columns, out, *times);
    if (options.to == "hdf5") return record::export_hdf5(reader, *table, *columns, out, *times);
    if (options.to == "mat") return record::export_mat(reader, *table, *columns, out, *times);
    if (options.to == "bids")
        return record::export_bids(reader, *table, *columns, out, {options.subject, options.task}, *times);
    return record::export_csv(reader, *table, *columns, out, *times);
}

// Refuses what a mesh or a document alone can be asked for.
Result<void> check_for_a_session(const ConvertOptions& options) {
    const std::array given{std::pair{"--units", options.units.has_value()},
                           std::pair{"--export-units", options.export_units.has_value()},
                           std::pair{"--close-holes", options.close_holes},
                           std::pair{"--weld", options.weld_m.has_value()},
                           std::pair{"--simplify", options.simplify_m.has_value()},
                           std::pair{"--center", options.center},
                           std::pair{"--place", options.place_m.has_value()},
                           std::pair{"--scale", options.scale.has_value()}};
    for (const auto& [name, is_given] : given)
        if (is_given) return fail(name, "is for meshes and documents", "leave it out, or leave out --to");
    return {};
}

}  // namespace

Result<void> convert_session(const ConvertOptions& options) {
    if (const auto ok = check_for_a_session(options); !ok) return ok;
    const std::string out = output_of(options);
    if (const auto ok = check_overwrites_none(out, std::array{options.in}); !ok) return ok;
    if (const auto ok = record::check_no_file(out); !ok) return ok;
    if (options.to == "log" && !(options.columns.empty() && options.part.empty() && options.trials.empty()))
        return fail("--to log", "has no columns, parts or trials to choose",
                    "leave --columns, --part and --trials out");
    Result<record::RecordReader> reader = record::RecordReader::open(options.in);
    if (!reader) return std::unexpected(reader.error());
    const Result<record::ExportReport> report = export_table(*reader, options, out);
    if (!report) return std::unexpected(report.error());
    for (const Error& error : report->damaged) std::fprintf(stderr, "burin: %s\n", error.line().c_str());
    if (out != kStandardOutput && options.to == "log")
        std::printf("%s: %s\n", out.c_str(), counted(report->rows, "line", "lines").c_str());
    else if (out != kStandardOutput)
        std::printf("%s: %s, %s\n", out.c_str(), counted(report->rows, "tick", "ticks").c_str(),
                    counted(report->columns, "column", "columns").c_str());
    if (report->damaged.empty()) return {};
    return fail(options.in, counted(report->damaged.size(), "block is", "blocks are") + " damaged and left out",
                "the rest has been written");
}

struct SessionCommand::Options {
    std::string file, json, first, second, columns;
};

SessionCommand::SessionCommand(Command app)
    : options_(std::make_unique<Options>()), command_(app.subcommand("session", "Session files: recorded ticks")) {
    command_.require_subcommand();
    Options& o = *options_;
    info_ =
        command_.subcommand("info", "What is in a session file: columns with units and frames, ticks, gaps, clocks");
    info_.option("FILE", o.file, "A file that --record has written").required();
    info_.option("--json", o.json, "A file for all of it; - for standard output");
    check_ = command_.subcommand(
        "check", "Read all of a session file and name what is damaged or was changed; exit status 1 then");
    check_.option("FILE", o.file, "A file that --record has written").required();
    Command compared =
        command_.subcommand("compare", "The first difference of two session files; exit status 1 where there is one");
    compared.option("A", o.first, "A file that --record has written").required();
    compared.option("B", o.second, "Another").required();
    compared.option("--columns", o.columns,
                    "Names with commas between them, a star at the end for all that begin so; else all");
}

SessionCommand::~SessionCommand() = default;

bool SessionCommand::parsed() const { return command_.parsed(); }

Result<void> SessionCommand::run() const {
    const Options& o = *options_;
    if (info_.parsed()) return info(o.file, o.json);
    if (check_.parsed()) return check(o.file);
    return compare(o.first, o.second, o.columns);
}

}  // namespace burin::app
