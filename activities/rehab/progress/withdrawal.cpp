// SPDX-License-Identifier: MIT
#include "activities/rehab/progress/withdrawal.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <span>
#include <system_error>

#include "activities/rehab/progress/kept_run.hpp"
#include "activities/rehab/progress/run_journal.hpp"
#include "base/file_io.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "base/try.hpp"

namespace burin::activities {
namespace {

namespace fs = std::filesystem;

fs::path list_of(const fs::path& folder) { return folder / "withdrawn.json"; }

fs::path own_folder(const fs::path& folder, unsigned participant) {
    return folder / formatted("participant-%03u", participant);
}

Result<void> write_list(const fs::path& folder, const Withdrawals& withdrawals) {
    Json list = Json::array();
    for (const Withdrawal& one : withdrawals)
        list.push_back({{"participant", one.participant}, {"date", one.date}, {"erased", one.erased}});
    return write_private(list_of(folder), json_text({{"withdrawn", std::move(list)}}));
}

// Brings a folder's names to the disk. One that cannot be opened has been written to all the same.
void flush_to_disk(const fs::path& folder) {
    const int opened = ::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    if (opened < 0) return;
    ::fsync(opened);
    ::close(opened);
}

}  // namespace

Result<void> make_private(const fs::path& place) {
    std::error_code error;
    const bool is_folder = fs::is_directory(place, error);
    const fs::perms owner = fs::perms::owner_read | fs::perms::owner_write;
    fs::permissions(place, is_folder ? owner | fs::perms::owner_exec : owner, error);
    if (!error) return {};
    return fail(place.string(), "cannot be made its owner's alone: " + error.message(),
                "keep results in a folder of your own, on a disk that knows owners");
}

// An existing file keeps its permissions when it is written anew. A new one is made, empty, under a name that nobody
// reads, before there is anything in it; so it is never found without its text.
Result<void> write_private(const fs::path& file, const std::string& text) {
    const auto bytes = std::as_bytes(std::span(text));
    std::error_code error;
    if (fs::exists(file, error)) {
        BURIN_TRY_DO(make_private(file));
        return write_file_atomically(file, bytes);
    }
    BURIN_TRY_DO(check_writable(file));
    const fs::path part =
        file.parent_path() / formatted(".%s.%ld.part", file.filename().c_str(), static_cast<long>(::getpid()));
    auto written = write_file_atomically(part, {});
    if (written) written = make_private(part);
    if (written) written = write_file_atomically(part, bytes);
    if (written) {
        fs::rename(part, file, error);
        if (error)
            written = fail(file.string(), "cannot be written: " + error.message(), "see to its folder's permissions");
    }
    if (!written) {
        fs::remove(part, error);
        return fail(file.string(), written.error().what, written.error().remedy);
    }
    flush_to_disk(file.parent_path());
    return {};
}

Result<Withdrawals> read_withdrawals(const fs::path& folder) {
    std::error_code error;
    const fs::path file = list_of(folder);
    Withdrawals withdrawals;
    if (!fs::exists(file, error)) return withdrawals;
    BURIN_TRY(text, read_text_file(file));
    const Json json = Json::parse(text, nullptr, false);
    const Json* const list = json.is_object() ? find_value(json, "/withdrawn") : nullptr;
    const auto damaged = [&] {
        return fail(file.string(), "does not say who has withdrawn: it is damaged", "restore it from a copy");
    };
    if (list == nullptr || !list->is_array()) return damaged();
    for (const Json& one : *list) {
        const Json* const number = one.is_object() ? find_value(one, "/participant") : nullptr;
        const Json* const date = one.is_object() ? find_value(one, "/date") : nullptr;
        const Json* const erased = one.is_object() ? find_value(one, "/erased") : nullptr;
        if (number == nullptr || !number->is_number_unsigned() || date == nullptr || !date->is_string() ||
            erased == nullptr || !erased->is_boolean())
            return damaged();
        withdrawals.push_back({number->get<unsigned>(), date->get<std::string>(), erased->get<bool>()});
    }
    return withdrawals;
}

bool has_withdrawn(const Withdrawals& withdrawals, unsigned participant) {
    return std::ranges::find(withdrawals, participant, &Withdrawal::participant) != withdrawals.end();
}

Result<void> withdraw(const fs::path& folder, unsigned participant, const std::string& date, bool erase) {
    BURIN_TRY(withdrawals, read_withdrawals(folder));
    const std::string name = formatted("participant %u", participant);
    const fs::path own = own_folder(folder, participant);
    std::error_code error;
    const bool is_there = fs::exists(fs::symlink_status(own, error));
    const auto told = std::ranges::find(withdrawals, participant, &Withdrawal::participant);
    if (told == withdrawals.end() && !is_there)
        return fail(name, "has no runs in " + folder.string(), "name the folder that --results was given");
    if (told != withdrawals.end() && (!erase || (told->erased && !is_there)))
        return fail(name, "has withdrawn already",
                    erase ? "nothing is left to erase" : "add --erase to erase the runs");
    if (erase && fs::is_symlink(own, error))
        return fail(own.string(), "is a link, so that the runs themselves would stay",
                    "put the folder in the link's place, or erase it by hand where it is");
    Result<session::DocumentLock> lock;  // whoever does an exercise now would write it down after this
    if (is_there) lock = take_participant(folder, participant);
    if (!lock) return std::unexpected(lock.error());
    if (told == withdrawals.end())
        withdrawals.push_back({participant, date, erase});
    else
        told->erased = erase;
    BURIN_TRY_DO(write_list(folder, withdrawals));
    if (!erase) {
        for (const char* page : {"progress.html", "progress.csv"}) fs::remove(own / page, error);
        return {};
    }
    fs::remove_all(own, error);
    if (!error) return {};
    return fail(own.string(), "cannot be erased: " + error.message(), "delete it by hand");
}

}  // namespace burin::activities
