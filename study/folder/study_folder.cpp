// SPDX-License-Identifier: MIT
#include "study/folder/study_folder.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <random>
#include <span>
#include <system_error>
#include <utility>

#include "base/file_io.hpp"
#include "base/places.hpp"
#include "base/sha256.hpp"
#include "base/text.hpp"
#include "base/try.hpp"
#include "study/assign/sealed_list.hpp"
#include "study/folder/study_access.hpp"

namespace burin::study {
namespace fs = std::filesystem;
namespace {

Result<void> write_whole(const fs::path& path, const std::string& text) {
    return write_file_atomically(path, std::as_bytes(std::span(text.data(), text.size())));
}

constexpr std::uint64_t kMostSealedBytes = std::uint64_t{256} << 20, kMostKeyBytes = 1024;
constexpr const char* kSealedFile = "allocation.sealed";

std::vector<std::vector<AllocationPlace>> lists_of(const Protocol& protocol, std::uint64_t seed,
                                                   std::size_t participants) {
    std::vector<unsigned> ratios;
    for (const Group& g : protocol.groups) ratios.push_back(g.ratio);
    std::vector<std::vector<AllocationPlace>> lists;
    const std::size_t strata = combinations(protocol.strata).size();
    for (std::size_t s = 0; s < strata; ++s) lists.push_back(allocate(ratios, protocol.blocks, seed, s, participants));
    return lists;
}

// From the system; whole 32 bits each.
std::uint64_t drawn_by_the_system() {
    std::random_device device;
    return (std::uint64_t{device()} << 32) | std::uint64_t{device()};
}

// Whoever reads the key reads the list: for its owner alone.
Result<void> write_key(const fs::path& file, const std::string& key) {
    BURIN_TRY_DO(write_whole(file, key + "\n"));
    std::error_code ignored;
    fs::permissions(file, fs::perms::owner_read | fs::perms::owner_write, ignored);
    return {};
}

Result<std::string> read_key(const fs::path& file) {
    auto key = read_text_file(file, kMostKeyBytes);
    if (!key) return std::unexpected(key.error());
    while (!key->empty() && (key->back() == '\n' || key->back() == ' ')) key->pop_back();
    return key;
}

// Texts and counts of a journal's entry; empty and 0 where they are missing or of another kind.
std::string text_in(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_string() ? found->get<std::string>() : std::string();
}

std::size_t count_in(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_number_unsigned() ? found->get<std::size_t>() : 0;
}

std::optional<double> number_in(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

bool flag_in(const Json& entry, const char* key) {
    const auto found = entry.find(key);
    return found != entry.end() && found->is_boolean() && found->get<bool>();
}

Result<std::string> digest_of_file(const fs::path& file) {
    BURIN_TRY(bytes, read_file(file, kMostRecordingBytes));
    return sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

Participant enrolled_by(const Json& entry) {
    Participant p;
    p.id = text_in(entry, "participant");
    p.stratum = text_in(entry, "stratum");
    p.group = text_in(entry, "group");
    p.position = count_in(entry, "position");
    p.simulated = flag_in(entry, "simulated");
    if (p.simulated) p.held = HeldDevice{kLearnersDevice, Hand::learner};
    return p;
}

// Journals of before December 2026 do not number the runs; where the motion was recorded its file is numbered.
std::size_t run_begun(const Participant& p, const Json& entry, const StageVisit& begun) {
    if (const std::size_t run = count_in(entry, "run"); run > 0) return run;
    std::size_t day = 0, place = 0, run = 0;
    const std::size_t name = begun.recording.rfind('/') + 1;
    if (std::sscanf(begun.recording.c_str() + name, "day%zu-%zu-run%zu", &day, &place, &run) == 3 && run > 0)
        return run;
    return 1 + static_cast<std::size_t>(std::ranges::count_if(
                   p.visits, [&](const StageVisit& v) { return v.day == begun.day && v.place == begun.place; }));
}

HeldDevice held_in(const Json& entry) {
    const std::string device = text_in(entry, "device");
    const std::optional<Hand> hand = hand_named(text_in(entry, "hand"));
    return hand ? HeldDevice{device, *hand} : held_by_name(device);
}

void visit(Participant& p, const Json& entry, const std::string& event) {
    const std::size_t day = count_in(entry, "day"), place = count_in(entry, "place");
    if (event == "stage begun") {
        StageVisit begun{.day = day, .place = place, .stage = text_in(entry, "stage")};
        begun.recording = text_in(entry, "recording");
        begun.held = p.held.value_or(HeldDevice{});
        begun.run = run_begun(p, entry, begun);
        begun.begun_utc = text_in(entry, "time");
        begun.clock_s = number_in(entry, "clock_s");
        p.visits.push_back(std::move(begun));
        return;
    }
    const auto begun = std::ranges::find_if(p.visits.rbegin(), p.visits.rend(), [&](const StageVisit& v) {
        return v.day == day && v.place == place && v.status == StageStatus::aborted;
    });
    if (begun == p.visits.rend()) return;
    begun->status = StageStatus::ended;
    begun->result = text_in(entry, "result");
    begun->ended_utc = text_in(entry, "time");
    begun->file = text_in(entry, "file");
    begun->file_digest = text_in(entry, "digest");
    begun->recording_digest = text_in(entry, "recording_sha256");
    begun->ended_clock_s = number_in(entry, "clock_s");
    const auto failures = entry.find("failures");
    if (failures == entry.end() || !failures->is_object()) return;
    for (const auto& [why, times] : failures->items())
        if (times.is_number_unsigned()) begun->failures[why] = times.get<std::size_t>();
}

bool good_id(const std::string& id) {
    return !id.empty() && id.size() <= 32 && id.find_first_not_of(kLettersOfCodes) == std::string::npos &&
           id.find_first_of("0123456789") != std::string::npos;
}

// One for each stratum.
bool are_codes_of(const Protocol& protocol, const std::vector<std::string>& codes) {
    const auto all = combinations(protocol.strata);
    return std::ranges::find(all, codes) != all.end();
}

std::string wanted_codes(const Protocol& protocol) {
    if (protocol.strata.empty()) return "give no --codes: the protocol has no strata";
    std::string text = "give --codes with";
    for (const Stratum& s : protocol.strata) {
        text += " one of";
        for (const std::string& code : s.codes) text += " " + code;
        text += " (" + s.name + ")";
    }
    return text;
}

}  // namespace

bool Participant::has_ended(std::size_t day, std::size_t place) const {
    return std::ranges::any_of(visits, [&](const StageVisit& v) {
        return v.day == day && v.place == place && v.status == StageStatus::ended;
    });
}

std::vector<Participant> participants_of(const Journal& journal) {
    std::vector<Participant> all;
    for (const JournalEntry& entry : journal.entries) {
        const std::string event = text_in(entry.value, "event"), id = text_in(entry.value, "participant");
        const auto found = std::ranges::find(all, id, &Participant::id);
        if (event == "enrolled" && found == all.end() && good_id(id)) {
            all.push_back(enrolled_by(entry.value));
            all.back().has_words = entry.has_words;
            continue;
        }
        if (found == all.end()) continue;
        found->has_words = found->has_words || entry.has_words;
        if (event == "withdrawn") {
            found->withdrawn = true;
            found->erased = found->erased || flag_in(entry.value, "erase");
        }
        if (event == "visit") found->held = held_in(entry.value);
        if (event == "deviation")
            found->deviations.push_back({text_in(entry.value, "time"), text_in(entry.value, "text")});
        if (event == "stage begun" || event == "stage ended") visit(*found, entry.value, event);
    }
    return all;
}

std::vector<StagePlace> places_of(const Protocol& protocol) {
    std::vector<StagePlace> places;
    for (std::size_t d = 0; d < protocol.days.size(); ++d) {
        const Day& day = protocol.days[d];
        for (std::size_t i = 0; i < day.stages.size(); ++i)
            places.push_back({d + 1, i + 1, protocol.stage(day.stages[i])});
    }
    return places;
}

Result<void> create_study(const fs::path& folder, const std::string& protocol_text, const StudyMaking& making) {
    std::error_code error;
    BURIN_TRY_DO(check_working_folder(folder));
    if (fs::exists(fs::symlink_status(folder, error)))
        return fail(folder.string(), "exists already", "name a folder that does not, so that nothing is overwritten");
    if (!making.key.empty() && fs::exists(fs::symlink_status(making.key, error)))
        return fail(making.key.string(), "exists already", "name a file that does not, for the key");
    const ParsedProtocol parsed = parse_protocol(protocol_text);
    if (!parsed.faults.empty()) return fail("protocol", "has faults", "correct them");
    fs::path part = folder;
    part += "." + std::to_string(::getpid()) + ".part";
    if (!fs::create_directories(part / "data", error))
        return fail(part.string(), "cannot be made: " + error.message(), "choose another place");
    // A seed that was drawn for the list is kept nowhere; learners have another.
    const std::uint64_t list_seed = making.seed ? *making.seed : drawn_by_the_system();
    const std::string key = sha256(formatted("%016llx%016llx%016llx%016llx", drawn_by_the_system(),
                                             drawn_by_the_system(), drawn_by_the_system(), drawn_by_the_system()));
    const std::string sealed =
        seal_allocation(parsed.protocol, lists_of(parsed.protocol, list_seed, making.participants), key);
    const StudyFacts facts{sha256(protocol_text), sha256(sealed),
                           making.seed ? *making.seed : drawn_by_the_system() % 1'000'000'000, making.seed.has_value(),
                           making.participants};
    const Json json{{"format", 3},
                    {"protocol_sha256", facts.protocol_digest},
                    {"allocation_sha256", facts.allocation_digest},
                    {"seed", facts.seed},
                    {"seed_given", facts.seed_given},
                    {"participants", facts.participants}};
    Result<void> ok = write_whole(part / "protocol.toml", protocol_text);
    if (ok) ok = write_whole(part / kSealedFile, sealed);
    if (ok) ok = write_whole(part / "study.json", json_text(json));
    if (ok) ok = write_whole(part / "lock", "");
    Journal journal = parse_journal("");
    if (ok) {
        ok = append(part / "journal.jsonl", journal,
                    Json{{"event", "study made"},
                         {"protocol_sha256", facts.protocol_digest},
                         {"allocation_sha256", facts.allocation_digest},
                         {"seed", facts.seed},
                         {"seed_given", facts.seed_given}});
    }
    if (ok) ok = write_key(making.key.empty() ? part / "allocation.key" : making.key, key);
    if (ok) {
        fs::rename(part, folder, error);
        if (error) ok = fail(folder.string(), "cannot be made: " + error.message(), "choose another place");
    }
    if (!ok) fs::remove_all(part, error);
    return ok;
}

StudyFolder::StudyFolder(StudyFolder&& other) noexcept
    : path_(std::move(other.path_)),
      key_(std::move(other.key_)),
      protocol_(std::move(other.protocol_)),
      protocol_text_(std::move(other.protocol_text_)),
      facts_(std::move(other.facts_)),
      journal_(std::move(other.journal_)),
      sealed_(std::move(other.sealed_)),
      lock_(std::exchange(other.lock_, -1)) {}

StudyFolder::~StudyFolder() {
    if (lock_ >= 0) ::close(lock_);  // gives the lock back
}

Result<StudyFolder> StudyFolder::open(const fs::path& folder, StudyAccess access) {
    StudyFolder study;
    study.path_ = folder;
    const std::string name = folder.string();
    if (access == StudyAccess::write) {
        study.lock_ = ::open((folder / "lock").c_str(), O_RDWR | O_CLOEXEC);
        if (study.lock_ < 0) return std::unexpected(no_study(folder, errno, true));
        if (::flock(study.lock_, LOCK_EX | LOCK_NB) != 0)
            return fail(name, "is in use by another burin", "wait until it has ended, or stop it");
        BURIN_TRY_DO(check_may_write(folder / "journal.jsonl"));
    }
    if (::faccessat(AT_FDCWD, (folder / "study.json").c_str(), R_OK, AT_EACCESS) != 0)
        return std::unexpected(no_study(folder, errno, false));
    const auto json_read = read_text_file(folder / "study.json", kMostProtocolBytes);
    if (!json_read) return fail(name, "is no study: " + json_read.error().what, "make one with burin study init");
    const Json json = Json::parse(*json_read, nullptr, false);
    if (!json.is_object()) return fail(name + "/study.json", "is damaged", "restore it from a copy");
    if (count_in(json, "format") != 3)
        return fail(name + "/study.json", "is of another version of Burin",
                    "go on with the version that made the study");
    study.facts_ = {text_in(json, "protocol_sha256"), text_in(json, "allocation_sha256"), count_in(json, "seed"),
                    flag_in(json, "seed_given"), count_in(json, "participants")};
    BURIN_TRY(bytes, read_file(folder / "protocol.toml", kMostProtocolBytes));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (sha256(text) != study.facts_.protocol_digest)
        return fail(name + "/protocol.toml", "is not the protocol that this study was made with",
                    "restore it; for another version of the protocol make a new study");
    ParsedProtocol parsed = parse_protocol(text);
    if (!parsed.faults.empty())
        return fail(line_of(parsed.faults.front(), name + "/protocol.toml"), "this Burin refuses the protocol",
                    "use the version that the study was made with");
    study.protocol_ = std::move(parsed.protocol);
    study.protocol_text_ = text;
    BURIN_TRY(journal, read_file(folder / "journal.jsonl", kMostJournalBytes));
    study.journal_ = parse_journal({reinterpret_cast<const char*>(journal.data()), journal.size()});
    return study;
}

Result<void> StudyFolder::note(Json value) {
    BURIN_CHECK(lock_ >= 0);
    const std::string name = (path_ / "journal.jsonl").string();
    // Without its beginning nobody knows who was enrolled: a place would be given twice.
    if (journal_.entries.empty() || journal_.entries.front().value["event"] != "study made")
        return fail(name, "has lost its beginning, which says how the study was made",
                    "restore the journal from a copy; nothing is written until then");
    return append(name, journal_, std::move(value));
}

Result<std::string> StudyFolder::sealed_list() const {
    auto sealed = read_text_file(path_ / kSealedFile, kMostSealedBytes);
    if (!sealed) return sealed;
    if (sha256(*sealed) != facts_.allocation_digest)
        return fail((path_ / kSealedFile).string(), "is not the list that this study was made with",
                    "restore it from a copy");
    return sealed;
}

Result<void> StudyFolder::check_allocation() const {
    BURIN_TRY(sealed, sealed_list());
    for (const JournalEntry& entry : journal_.entries) {
        if (text_in(entry.value, "event") == "study made" &&
            text_in(entry.value, "allocation_sha256") != facts_.allocation_digest)
            return fail((path_ / kSealedFile).string(), "is not the list that the journal names",
                        "restore study.json and allocation.sealed from a copy");
    }
    const auto key = read_key(key_file());
    if (!key) return {};  // it is kept elsewhere
    for (const Participant& p : participants()) {
        if (p.erased && p.position == 0) continue;  // nobody knows its place any more
        const auto place = open_place(sealed, protocol_, *key, p.stratum, p.position);
        if (!place) return std::unexpected(place.error());
        if (protocol_.groups[place->group].code != p.group)
            return fail(p.id, "is not in the group of its place in the list", "see who changed the journal");
    }
    return {};
}

Result<Participant> StudyFolder::enrol(const std::string& id, const std::vector<std::string>& codes, bool simulated) {
    if (!good_id(id))
        return fail(id.substr(0, 64), "is not a participant's code",
                    "write up to 32 letters, digits, - and _, with a digit among them, such as p07; never a name");
    const std::vector<Participant> all = participants();
    if (std::ranges::find(all, id, &Participant::id) != all.end())
        return fail(id, "is in this study already", "give a code that nobody has had");
    if (!are_codes_of(protocol_, codes)) return fail("--codes", "do not fit the strata", wanted_codes(protocol_));
    const std::string label = stratum_label(codes);
    const auto strata = combinations(protocol_.strata);
    const std::size_t position =
        places_taken()[static_cast<std::size_t>(std::ranges::find(strata, codes) - strata.begin())];
    if (sealed_.empty()) {
        BURIN_TRY(sealed, sealed_list());
        sealed_ = std::move(sealed);
    }
    const auto key = read_key(key_file());
    if (!key)
        return fail(key_file().string(), "the key of the allocation cannot be read: " + key.error().what,
                    "name it with --key, or have whoever keeps it enrol");
    const auto place = open_place(sealed_, protocol_, *key, label, position + 1);
    if (!place) return fail(path_.string(), place.error().what, place.error().remedy);
    Participant p{.id = id, .stratum = label, .group = protocol_.groups[place->group].code, .codes = codes};
    p.position = position + 1;
    p.simulated = simulated;
    const Json entry{{"event", "enrolled"},    {"participant", id}, {"stratum", label},
                     {"position", p.position}, {"group", p.group},  {"consent", protocol_.consent_version},
                     {"simulated", simulated}};
    BURIN_TRY_DO(note(entry));
    return p;
}

std::optional<double> StudyFolder::simulated_effect() const {
    for (const JournalEntry& entry : journal_.entries) {
        const auto effect = entry.value.find("effect");
        if (text_in(entry.value, "event") == "simulation" && effect != entry.value.end() && effect->is_number())
            return effect->get<double>();
    }
    return std::nullopt;
}

Result<void> StudyFolder::begin_simulation(double effect) {
    const std::optional<double> before = simulated_effect();
    if (!before) return note(Json{{"event", "simulation"}, {"effect", effect}});
    if (*before == effect) return {};
    return fail(path_.string(), formatted("was begun with an effect of %g SD", *before),
                formatted("give --effect %g, or make another study", *before));
}

Result<void> StudyFolder::note_of(const std::string& id, const std::string& text) {
    return note(Json{{"event", "note"}, {"participant", id}, {"text", text}});
}

Result<void> StudyFolder::note_deviation(const std::string& id, const std::string& text) {
    return note(Json{{"event", "deviation"}, {"participant", id}, {"text", text}});
}

Result<void> StudyFolder::begin_visit(const std::string& id, const HeldDevice& held) {
    return note(Json{{"event", "visit"},
                     {"participant", id},
                     {"device", held.device},
                     {"hand", name_of(held.hand)},
                     {"felt_by_person", held.felt_by_person()}});
}

std::string files_begin(const std::string& id, std::size_t day, std::size_t place, std::size_t run) {
    return "data/" + id + formatted("/day%zu-%02zu-run%zu", day, place, run);
}

// The number of the run that comes next.
std::size_t StudyFolder::run_after(const std::string& id, const StagePlace& at) const {
    std::size_t run = 0;
    for (const JournalEntry& entry : journal_.entries) {
        const Json& value = entry.value;
        if (text_in(value, "participant") != id || text_in(value, "event") != "stage begun") continue;
        if (count_in(value, "day") == at.day && count_in(value, "place") == at.place)
            run = std::max(run + 1, count_in(value, "run"));
    }
    return run + 1;
}

Result<StageFiles> StudyFolder::begin_stage(const std::string& id, const StagePlace& at, bool has_motion,
                                            std::optional<double> clock_s) {
    std::error_code error;
    fs::create_directories(path_ / "data" / id, error);
    if (error) return fail((path_ / "data" / id).string(), "cannot be made: " + error.message());
    // Files that an interrupted run left are kept: the next run's have a number of their own.
    StageFiles files{run_after(id, at), {}, {}};
    std::string begin;
    for (begin = files_begin(id, at.day, at.place, files.run);
         fs::exists(path_ / (begin + ".json"), error) || fs::exists(path_ / (begin + ".session"), error);
         begin = files_begin(id, at.day, at.place, files.run))
        ++files.run;
    files.measured = begin + ".json";
    if (has_motion) files.recording = begin + ".session";
    Json entry{{"event", "stage begun"}, {"participant", id},       {"day", at.day},
               {"place", at.place},      {"stage", at.stage->name}, {"run", files.run}};
    if (has_motion) entry["recording"] = files.recording;
    if (clock_s) entry["clock_s"] = *clock_s;
    BURIN_TRY_DO(note(std::move(entry)));
    return files;
}

Result<void> StudyFolder::end_stage(const std::string& id, const StagePlace& at, const std::string& result,
                                    const Json& recorded, const StageFiles& files, const Json& failures,
                                    std::optional<double> clock_s) {
    Json entry{{"event", "stage ended"}, {"participant", id},       {"day", at.day},
               {"place", at.place},      {"stage", at.stage->name}, {"result", result}};
    if (!failures.is_null()) entry["failures"] = failures;
    if (clock_s) entry["clock_s"] = *clock_s;
    if (!files.recording.empty()) {
        BURIN_TRY(digest, digest_of_file(path_ / files.recording));
        entry["recording_sha256"] = digest;
    }
    if (!recorded.is_null()) {
        const std::string text = json_text(recorded);
        BURIN_TRY_DO(write_whole(path_ / files.measured, text));
        entry["file"] = files.measured;
        entry["digest"] = sha256(text);
    }
    return note(std::move(entry));
}

Result<void> StudyFolder::check_recording(const StageVisit& visit) const {
    BURIN_TRY(digest, digest_of_file(path_ / visit.recording));
    if (digest != visit.recording_digest)
        return fail((path_ / visit.recording).string(), "is not what the journal says was recorded",
                    "restore it from a copy");
    return {};
}

Result<Json> StudyFolder::recorded(const StageVisit& visit) const {
    const fs::path file = path_ / visit.file;
    BURIN_TRY(bytes, read_file(file, kMostJournalBytes));
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    if (sha256(text) != visit.file_digest)
        return fail(file.string(), "is not what the journal says was recorded", "restore it from a copy");
    return Json::parse(text, nullptr, false);
}

}  // namespace burin::study
