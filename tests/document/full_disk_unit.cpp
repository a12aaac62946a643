// SPDX-License-Identifier: MIT
// A disk that fills up and has room again, at any moment: what was acknowledged is in the document or in the journal,
// whole. More runs: BURIN_FULL_DISK_RUNS (scripts/soak-document).
#include <gtest/gtest.h>
#include <sched.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <random>
#include <thread>

#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "tests/record/failing_disk.hpp"
#include "tests/support/run_command.hpp"

namespace burin::document {
namespace {

constexpr std::int64_t kChanges = 300;

// A page that says which change it is after, among bytes that no compression makes small.
std::vector<std::byte> after_change(std::int64_t number) {
    std::vector<std::byte> bytes(2000);
    std::mt19937 noise(static_cast<unsigned>(number));
    for (std::byte& b : bytes) b = static_cast<std::byte>(noise());
    std::memcpy(bytes.data(), &number, sizeof number);
    return bytes;
}

// The number in such a page; -1: it is none.
std::int64_t number_in(const std::vector<std::byte>& bytes) {
    std::int64_t number = -1;
    if (bytes.size() == 2000) std::memcpy(&number, bytes.data(), sizeof number);
    return number >= 0 && bytes == after_change(number) ? number : -1;
}

Content all_after(std::int64_t number) {
    Content content{.facts = {{kJournalNameFact, "work.burin"}}};
    content.parts.push_back({.part = "a thing"});
    content.parts[0].pages = {{{"tile", 0}, after_change(number)}};
    return content;
}

Change change_to(std::int64_t number) {
    return {.part = 0, .pages = {.part = "a thing", .whole = false, .pages = {{{"rays", 0}, after_change(number)}}}};
}

// The last change that a file holds; -1: there is no file, or something of it is not sound.
std::int64_t last_change_in(const std::string& path) {
    if (!std::filesystem::exists(path)) return -1;
    Result<DocumentReader> reader = DocumentReader::open(path);
    if (!reader) return -1;
    const Result<scene::Pages> pages = reader->pages(reader->parts().at(0));
    if (!pages || !pages->damaged.empty()) return -1;
    std::int64_t last = number_in(pages->pages.at({"tile", 0}));
    for (std::int64_t number = 1; number <= reader->changes(); ++number) {
        const Result<scene::Pages> change = reader->change(reader->parts().at(0), number);
        if (!change || number_in(change->pages.at({"rays", 0})) != last + 1) return -1;
        ++last;
    }
    return last;
}

int full_disk_runs() {
    const char* wanted = std::getenv("BURIN_FULL_DISK_RUNS");
    return wanted != nullptr ? std::max(1, std::atoi(wanted)) : 3;
}

}  // namespace

TEST(DiskThatFillsUp, LosesNothingThatWasAcknowledged) {
    record::test::FailingDisk& disk = record::test::failing_disk();
    std::mt19937 random(20);
    std::int64_t acknowledged_in_all = 0, refused_saves = 0;
    for (int run = 0; run < full_disk_runs(); ++run) {
        disk.reset();
        const Workplace at;
        const std::string journal = at / "work-1.burin", work = at / "work.burin";
        DocumentWriter writer(disk.kName, std::chrono::milliseconds(1), 40'000);
        writer.keep_journal(journal, all_after(0));
        for (std::int64_t number = 1; number <= kChanges; ++number) {
            if (random() % 15 == 0) disk.is_full = !disk.is_full;
            writer.note(change_to(number));
            if (random() % 40 == 0)
                writer.save({.path = work, .name = "work.burin", .content = all_after(number), .refused = {}});
            if (writer.wants_all()) writer.begin_anew(all_after(number));
            for (auto wait = random() % 200; wait > 0; --wait) sched_yield();
            // Whatever is there at this moment is there after a power cut as well: it has been flushed.
        }
        writer.finish();
        const std::int64_t acknowledged = writer.safe_up_to();
        disk.is_full = random() % 2 == 0;
        static_cast<void>(writer.end_journal(false));
        for (const SaveOutcome& ended : writer.take_outcomes()) refused_saves += ended.saved ? 0 : 1;
        disk.is_full = false;
        EXPECT_GE(std::max({last_change_in(journal), last_change_in(work), std::int64_t{0}}), acknowledged)
            << "run " << run;
        if (std::filesystem::exists(work)) {
            EXPECT_GE(last_change_in(work), 0) << "the document is whole, run " << run;
        }
        acknowledged_in_all += acknowledged;
    }
    EXPECT_GT(acknowledged_in_all, 0) << "else nothing was tried";
    std::printf("%d runs on a disk that fills up, %lld changes acknowledged, none lost; %lld saves refused\n",
                full_disk_runs(), static_cast<long long>(acknowledged_in_all), static_cast<long long>(refused_saves));
    disk.reset();
}

}  // namespace burin::document
