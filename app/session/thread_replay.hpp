// SPDX-License-Identifier: MIT
// Does again what the threads of a recorded session did, on one thread: ticks and updates of the carving side run when a frame needs them,
// each with what it saw then.
//
//   a frame needs the tick whose tool it drew, and after its own orders the updates whose news it had;
//   a tick needs the ticks before it, and the update that published the surface it saw; that surface is kept until no tick sees it any more,
//   and so are the parameters that frames publish: a tick may have seen older ones than what there is when it runs again;
//   an update needs the updates before it, the orders it took, and the ticks whose samples it took.
//
// A recording that was torn off lacks what its last frames need: log_ends(). One that was tampered with contradicts itself: an Error that
// names the line. One thread.
#pragma once

#include <deque>

#include "app/session/carving_thread.hpp"
#include "app/session/live_session.hpp"
#include "app/session/session_check.hpp"
#include "app/session/thread_log.hpp"

namespace burin {

class ThreadReplay {
public:
    // name: of the log's file. All must outlive it.
    ThreadReplay(LiveSession& session, const ThreadLog& log, const std::string& name);

    // ---- In a frame: its tool; then, after its step, its news and whether all is as it was.
    [[nodiscard]] Result<ToolState> tool_of(const FrameSeen& frame);
    void order(CarvingOrder order) { orders_.push_back(std::move(order)); }
    [[nodiscard]] Result<std::optional<SurfaceNews>> news_of(const FrameSeen& frame);
    [[nodiscard]] bool is_as_recorded(const FrameSeen& frame);

    // ---- After the last frame: what the threads did until they were stopped, and the news of that.
    [[nodiscard]] Result<std::optional<SurfaceNews>> finish();

    // After an Error: the log just ends there.
    [[nodiscard]] bool log_ends() const { return log_ends_; }

private:
    [[nodiscard]] Result<void> run_ticks(std::uint64_t last);
    [[nodiscard]] Result<void> run_tick();
    [[nodiscard]] Result<void> run_updates(std::uint64_t last);
    [[nodiscard]] Result<void> run_update();
    [[nodiscard]] Result<void> give_orders(std::size_t count);
    void keep_surface();
    void keep_parameters();
    [[nodiscard]] std::unexpected<Error> ends(const std::string& what);
    [[nodiscard]] std::unexpected<Error> contradiction(std::size_t line, const std::string& what) const;

    LiveSession& session_;
    const ThreadLog& log_;
    std::string name_;
    ThreadLinesReader<TickText> tick_lines_;
    ThreadLinesReader<UpdateText> update_lines_;
    std::uint64_t ticks_ = 0, updates_ = 0;  // done
    bool updating_ = false;
    std::uint64_t ticking_ = 0;          // the tick that is begun; 0: none
    std::deque<LocalSurface> surfaces_;  // that ticks may yet see, by their sequence
    std::deque<TickParameters> parameters_;
    std::deque<ToolState> tools_;                                            // after the ticks that frames may yet see
    std::deque<CarvingOrder> orders_;                                        // that no update has taken yet
    std::deque<std::pair<std::uint64_t, std::optional<SurfaceNews>>> news_;  // of updates that no frame has taken yet
    SessionCheck check_;
    bool log_ends_ = false;
};

}  // namespace burin
