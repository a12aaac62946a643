// SPDX-License-Identifier: MIT
#include "bench/document/document_bench.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <deque>
#include <filesystem>
#include <fstream>

#include "base/text.hpp"
#include "base/try.hpp"
#include "bench/measure/scenes.hpp"
#include "bench/measure/timing.hpp"
#include "document/document_reader.hpp"
#include "document/document_writer.hpp"
#include "geometry/files/closed_mesh.hpp"
#include "geometry/files/mesh_export.hpp"
#include "record/compressed.hpp"
#include "sculpt/carved_part.hpp"
#include "sculpt/load_workpiece.hpp"

namespace burin::bench {
namespace {

namespace fs = std::filesystem;

constexpr Nanoseconds kUpdate_ns = 10'000'000, kLook_ns = 1'000'000;
constexpr unsigned kUpdatesOfAStroke = 100;
constexpr std::size_t kHistoryBytes = std::size_t{256} << 20;  // as sculpt --undo-memory has it

// Files of the benchmark, which go with it.
class OwnFolder {
public:
    explicit OwnFolder(const std::string& in) : path_(fs::path(in) / formatted("burin-bench-document-%d", ::getpid())) {
        std::error_code ignored;
        fs::create_directory(path_, ignored);
    }
    ~OwnFolder() {
        std::error_code ignored;
        fs::remove_all(path_, ignored);
    }
    OwnFolder(const OwnFolder&) = delete;
    OwnFolder& operator=(const OwnFolder&) = delete;
    [[nodiscard]] std::string file(const char* name) const { return (path_ / name).string(); }

private:
    fs::path path_;
};

Result<CarveScene> carved_scene(const DocumentTask& task) {
    if (task.mesh.empty()) return stroke_1000_scene();
    BURIN_TRY(closed, geometry::load_closed_mesh({.file = task.mesh, .close_holes = true, .units = LengthUnit::m}));
    return stroke_on_mesh_scene(fs::path(task.mesh).stem().string(), std::move(closed.mesh), false);
}

Result<std::unique_ptr<sculpt::Sculpture>> uncut(const CarveScene& scene, int resolution, WorkerPool& pool) {
    BURIN_TRY(solid, uncut_solid(scene, resolution, pool));
    auto sculpture = std::make_unique<sculpt::Sculpture>(compute::make_cpu_engine(std::move(solid), pool), pool);
    sculpture->keep_history(kHistoryBytes);
    sculpture->note_changes();
    return sculpture;
}

Result<void> cut(sculpt::Sculpture& sculpture, const CarveScene& scene, std::size_t sweep) {
    const compute::BallSweep ball = in_object(scene, scene.sweeps[sweep % scene.sweeps.size()]);
    const compute::ToolSweep as_tool{
        compute::BallTool{ball.radius_m}, {ball.start_object_m}, {ball.end_object_m}, ball.operation, ball.material};
    return sculpture.update({&as_tool, 1});
}

document::Content all_of(const sculpt::Sculpture& sculpture) {
    document::Content content;
    sculpture.copy(content.parts.emplace_back());
    return content;
}

// ---- Journal

// Updates whose changes are on no disk yet, with the number of the change that they are part of; 0: not told yet.
struct Unsafe {
    Nanoseconds since_ns = 0;
    std::int64_t change = 0;
};

void take_what_is_safe(std::deque<Unsafe>& unsafe, const document::DocumentWriter& writer, Nanoseconds now_ns,
                       DocumentFigures::Journal& figures) {
    const std::int64_t safe = writer.safe_up_to();
    while (!unsafe.empty() && unsafe.front().change != 0 && unsafe.front().change <= safe) {
        figures.unsafe_ms.push_back(1e3 * seconds(now_ns - unsafe.front().since_ns));
        unsafe.pop_front();
    }
}

// Returns why the journal is not written.
std::optional<Error> refused_journal(document::DocumentWriter& writer) {
    for (document::JournalNews& news : writer.take_journal_news())
        if (news.failed) return std::move(news.failed);
    return std::nullopt;
}

Result<void> measure_journal(const DocumentTask& task, const CarveScene& scene, const OwnFolder& folder,
                             WorkerPool& pool, DocumentFigures::Journal& figures) {
    BURIN_TRY(sculpture, uncut(scene, task.journal_resolution, pool));
    document::DocumentWriter writer;
    writer.keep_journal(folder.file("journal.burin"), all_of(*sculpture));
    writer.finish();
    if (const auto refused = refused_journal(writer)) return std::unexpected(*refused);
    MonotonicClock clock;
    std::deque<Unsafe> unsafe;
    Nanoseconds due_ns = clock.now_ns(), told_ns = due_ns;
    const auto look_until = [&](Nanoseconds until_ns) {
        for (Nanoseconds now_ns = clock.now_ns(); now_ns < until_ns; now_ns = clock.now_ns()) {
            take_what_is_safe(unsafe, writer, now_ns, figures);
            clock.sleep_until(std::min(until_ns, now_ns + kLook_ns));
        }
    };
    for (unsigned update = 0; update < task.updates; ++update) {
        look_until(due_ns += kUpdate_ns);
        const std::uint64_t before = sculpture->figures().rays_changed;
        BURIN_TRY_DO(cut(*sculpture, scene, update));
        const bool ends = (update + 1) % kUpdatesOfAStroke == 0 || update + 1 == task.updates;
        if (ends) sculpture->end_stroke();
        const Nanoseconds now_ns = clock.now_ns();
        if (sculpture->figures().rays_changed > before) {
            ++figures.updates;
            unsafe.push_back({now_ns, 0});
        }
        if (!ends && now_ns - told_ns < sculpt::CarvedPart::kJournal_ns) continue;
        told_ns = now_ns;
        std::vector<document::Change> changes;
        for (document::Change change; sculpture->take_change(change.pages); change = {})
            changes.push_back(std::move(change));
        figures.taken_ms.push_back(1e3 * seconds(clock.now_ns() - now_ns));
        for (document::Change& change : changes) writer.note(std::move(change));
        figures.changes = static_cast<std::uint64_t>(writer.noted());
        if (changes.empty()) continue;
        for (Unsafe& one : unsafe)
            if (one.change == 0) one.change = writer.noted();
    }
    constexpr Nanoseconds kLongest_ns = 10'000'000'000;
    for (const Nanoseconds end_ns = clock.now_ns() + kLongest_ns; !unsafe.empty() && clock.now_ns() < end_ns;)
        look_until(clock.now_ns() + kLook_ns);
    if (const auto refused = refused_journal(writer)) return std::unexpected(*refused);
    static_cast<void>(writer.end_journal(true));
    if (!unsafe.empty()) return fail(folder.file("journal.burin"), "takes more than 10 s to write", "check the disk");
    return {};
}

// ---- Save

std::uint64_t bytes_written_by_process() {
    std::ifstream counts("/proc/self/io");
    std::string name;
    for (std::uint64_t value = 0; counts >> name >> value;)
        if (name == "wchar:") return value;
    return 0;
}

Result<document::Saved> save(document::DocumentWriter& writer, document::SaveRequest request) {
    writer.save(std::move(request));
    writer.finish();
    return std::move(writer.take_outcomes().at(0).saved);
}

Result<void> measure_save(const DocumentTask& task, const CarveScene& scene, sculpt::Sculpture& sculpture,
                          const std::string& path, DocumentFigures::Save& figures) {
    document::DocumentWriter writer;
    document::SaveRequest first{.path = path, .name = path, .content = {}, .refused = {}};
    BURIN_TRY_DO(sculpture.save(first.content.parts.emplace_back()));
    BURIN_TRY_DO(save(writer, std::move(first)));

    const std::uint64_t before = sculpture.figures().rays_changed;
    for (unsigned stroke = 0; stroke < task.strokes; ++stroke) {
        // Spread over the whole way.
        BURIN_TRY_DO(cut(sculpture, scene, stroke * scene.sweeps.size() / task.strokes));
        sculpture.end_stroke();
    }
    figures.strokes = task.strokes;
    figures.rays_changed = sculpture.figures().rays_changed - before;
    for (scene::Pages changed; sculpture.take_change(changed); changed = {}) {
        for (const auto& [name, bytes] : changed.pages) {
            figures.changed_bytes += bytes.size();
            BURIN_TRY(packed, record::compressed(bytes));
            figures.changed_packed_bytes += packed.size();
        }
    }
    if (figures.changed_bytes == 0) return fail(task.mesh, "is cut by no stroke", "name another mesh");
    document::SaveRequest second{.path = path, .name = path, .content = {}, .changed_alone = true, .refused = {}};
    Stopwatch watch;
    scene::Pages& pages = second.content.parts.emplace_back();
    pages.whole = false;
    BURIN_TRY_DO(sculpture.save(pages));
    figures.taken_ms = watch.lap_ms();
    const std::uint64_t written_before = bytes_written_by_process();
    BURIN_TRY(saved, save(writer, std::move(second)));
    figures.written_ms = watch.lap_ms();
    figures.written_bytes = bytes_written_by_process() - written_before;
    figures.pages = saved.pages;
    figures.page_bytes = saved.page_bytes;
    return {};
}

// ---- Open and size

// Has the system forget what it holds of the file.
void forget(const std::string& path) {
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (fd < 0) return;
    static_cast<void>(::fsync(fd));
    static_cast<void>(::posix_fadvise(fd, 0, 0, POSIX_FADV_DONTNEED));
    ::close(fd);
}

Result<scene::Pages> read(const std::string& path) {
    BURIN_TRY(reader, document::DocumentReader::open(path));
    return reader.pages_of(workpiece::kSolidPart);
}

Result<void> measure_open(const std::string& path, bool is_cold, DocumentFigures::Open& figures) {
    if (is_cold) forget(path);
    Stopwatch watch;
    BURIN_TRY_DO(read(path));
    figures.read_ms.push_back(watch.lap_ms());
    if (is_cold) forget(path);
    static_cast<void>(watch.lap_ms());
    BURIN_TRY(pages, read(path));
    const auto loaded = workpiece::load_solid(pages, path);
    figures.open_ms.push_back(watch.lap_ms());
    if (!loaded) return std::unexpected(loaded.error());
    if (!loaded->lost.empty()) return fail(path, "is damaged: " + loaded->lost, "check the disk");
    return {};
}

Result<void> measure_size(const sculpt::Sculpture& sculpture, const OwnFolder& folder, const std::string& path,
                          DocumentFigures::Size& figures) {
    const std::string stl = folder.file("work.stl");
    BURIN_TRY_DO(geometry::export_mesh(sculpture.surface().welded(LengthUnit::mm), stl));
    std::error_code error;
    figures.document_bytes = fs::file_size(path, error);
    if (!error) figures.stl_bytes = fs::file_size(stl, error);
    if (error) return fail(path, "cannot be measured: " + error.message(), "check the folder and its disk");
    return {};
}

}  // namespace

Result<DocumentFigures> measure_documents(const DocumentTask& task) {
    BURIN_TRY(scene, carved_scene(task));
    DocumentFigures figures{.work = scene.name,
                            .journal_resolution = task.journal_resolution,
                            .resolution = task.resolution,
                            .journal = {},
                            .save = {},
                            .cold = {},
                            .warm = {},
                            .size = {}};
    WorkerPool pool;
    const OwnFolder folder(task.folder);
    const std::string path = folder.file("work.burin");
    BURIN_TRY_DO(measure_journal(task, scene, folder, pool, figures.journal));
    BURIN_TRY(sculpture, uncut(scene, task.resolution, pool));
    BURIN_TRY_DO(measure_save(task, scene, *sculpture, path, figures.save));
    for (unsigned run = 0; run < task.runs; ++run) {
        for (const bool is_cold : {true, false})
            BURIN_TRY_DO(measure_open(path, is_cold, is_cold ? figures.cold : figures.warm));
    }
    BURIN_TRY_DO(measure_size(*sculpture, folder, path, figures.size));
    return figures;
}

}  // namespace burin::bench
