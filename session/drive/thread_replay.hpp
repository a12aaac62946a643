// SPDX-License-Identifier: MIT
// Replays the threads of a recorded session on one thread: ticks and updates of the scene run when a frame needs
// them, each with the inputs it saw then.
//
//   a frame needs the tick whose tool it drew, and after its own orders the updates it had taken;
//   a tick needs the ticks before it, and the update that published the surface it saw; that surface is kept until no
//   tick sees it any more, and so are the parameters that frames publish: a tick may have seen older ones than those
//   that are newest when it is replayed;
//   an update needs the updates before it, the orders it took, and the ticks whose samples it took.
//
// A recording that was torn off lacks what its last frames need: log_ends(). One that was edited contradicts itself: an
// Error that names the line. One thread.
//
//   each frame: begin_frame(), advance_to(), tool() ... step, order(), take_updates(), is_as_recorded()
//   after the last frame: run_to_end(), take_updates()
#pragma once

#include <deque>
#include <memory>

#include "session/drive/driver.hpp"
#include "session/record/session_check.hpp"
#include "session/record/thread_log.hpp"

namespace burin::haptics {
struct PartInput;  // haptics/haptic_loop.hpp
}  // namespace burin::haptics

namespace burin::session {

class Session;      // session/live/session.hpp
class TickSource;   // session/record/tick_source.hpp
class TickWitness;  // session/drive/tick_witness.hpp

// Fails where the device of a session ticks at another rate than the log's. name: the log's file name.
[[nodiscard]] Result<void> check_rate(Session& session, const ThreadLog& log, const std::string& name);

class ThreadReplay final : public Executor {
public:
    // name: the log's file name. session and log must outlive it.
    // ticks: what the ticks of each part of the hands saw.
    ThreadReplay(Session& session, const ThreadLog& log, std::unique_ptr<TickSource> ticks, const std::string& name);
    ~ThreadReplay() override;

    // Has the ticks judged; null: by the frames' checksums alone.
    void judge_ticks(TickWitness* witness) { witness_ = witness; }
    // Says which frame of the log is the present one.
    void begin_frame(const FrameSeen& frame) { frame_ = &frame; }
    // Runs the ticks up to those whose tools the frame drew, whatever the time.
    [[nodiscard]] Result<void> advance_to(Nanoseconds until_ns) override;
    // Returns the tools as these ticks left them: an update may have needed later ticks.
    [[nodiscard]] std::vector<haptics::ToolState> tools() override;
    void order(Order order) override {
        if (!order.counts()) return order();
        orders_.push_back(std::move(order));
    }
    // Runs the updates that the frame had taken.
    [[nodiscard]] Result<Taken> take_updates() override;
    // Returns, after the frame's step, whether everything is as recorded. words: what the frame's checksum covers of
    // the state.
    [[nodiscard]] bool is_as_recorded(const StateWords& words);

    // Runs what the threads did after the last frame until they were stopped; nothing where the log does not say that
    // they were.
    [[nodiscard]] Result<void> run_to_end();

    // Returns, after an Error, whether the log just ends there.
    [[nodiscard]] bool log_ends() const { return log_ends_; }

private:
    struct Part;  // what is kept of each part of the hands
    [[nodiscard]] Result<void> run_turns(std::uint64_t last);
    [[nodiscard]] Result<bool> read_turn();
    [[nodiscard]] Result<void> run_turn();
    [[nodiscard]] Result<haptics::PartInput> input_of(std::size_t part);
    [[nodiscard]] Result<void> judge(std::size_t part);
    [[nodiscard]] Result<void> run_updates(std::uint64_t last);
    [[nodiscard]] Result<void> run_update();
    void keep_surfaces();
    void keep_parameters();
    [[nodiscard]] std::unexpected<Error> ends(const std::string& what);
    [[nodiscard]] Result<void> check_ends_together() const;
    [[nodiscard]] std::optional<std::string> hole() const;
    [[nodiscard]] std::unexpected<Error> contradiction(const std::string& where, const std::string& what) const;

    Session& session_;
    const ThreadLog& log_;
    std::string name_;
    const FrameSeen* frame_ = nullptr;  // the present one
    std::unique_ptr<TickSource> ticks_source_;
    ThreadLinesReader<UpdateText> update_lines_;
    std::uint64_t ticks_ = 0, updates_ = 0;  // done so far; a turn is a tick of each part
    bool updating_ = false;
    std::uint64_t ticking_ = 0;  // the turn in progress; 0: none
    std::vector<Part> parts_;
    std::deque<Order> orders_;  // not taken by an update yet
    SessionCheck check_;
    TickWitness* witness_ = nullptr;
    bool log_ends_ = false;
};

}  // namespace burin::session
