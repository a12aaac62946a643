// SPDX-License-Identifier: MIT
// Runs `burin sculpt` as a session: for a user at a window or before a wall, from a script, or from a recording.
//
// run_session() chooses between three kinds. Each opens what it needs, builds its executor and its source of frames,
// and lets drive() (driver.hpp) run them. Main thread.
#pragma once

#include "desk/present/direct_output.hpp"
#include "desk/timing/session_times.hpp"
#include "desk/view/session_screens.hpp"
#include "haptics/haptic_loop.hpp"
#include "record/record_reader.hpp"
#include "session/activity/activity_marks.hpp"
#include "session/drive/recording_start.hpp"
#include "session/drive/tick_witness.hpp"
#include "session/options/session_setup.hpp"
#include "session/record/input_source.hpp"
#include "session/record/log_outputs.hpp"

namespace burin::session {

// Returns whether these options ask for a session instead of a stroke.
[[nodiscard]] bool wants_session(const SessionSetup& options);

// A recording is replayed, any other log is a script. All commands of a log are checked before anything else is done,
// and its files go below one folder (session/record/log_outputs.hpp); the session fails at its end where one of them is
// missing. Without a log, or where one is to be recorded (live.record), time
// is real.
// facts: for a session file, into which it may be recorded.
[[nodiscard]] Result<void> run_session(const SessionSetup& options, const SessionFacts& facts = {});

// What a session has noted for the tables of its file.
struct SessionNotes {
    std::vector<TrialMark> trials;
    std::vector<EventMark> events;
};

// How a recording is replayed.
struct ReplayManner {
    bool draws = true;                      // its frames' pictures; their screenshots, too
    TickWitness* witness = nullptr;         // judges every tick; null: only the frames' checksums are compared
    record::RecordReader* ticks = nullptr;  // the session file that has the ticks, where the log has none
    SessionNotes* notes = nullptr;          // takes trials and events; null: nobody wants them
    // It is shown otherwise than it was recorded, on purpose: what a frame's checksum covers of the view differs, and
    // only ticks, trials, events and the surface at the end are judged.
    bool another_view = false;
    // What the log asked for and did not get then either is no failure of the replay.
    bool only_compares = false;
    Nanoseconds picture_every_ns = 0;  // with draws: of session time, as SECONDS.png; 0: none
};
// Replays a recording with its own options wherever they affect its frames; `given` says how it is shown. The log has
// threads, and all its commands make sense (check_commands()).
[[nodiscard]] Result<void> run_as_recorded(const SessionSetup& given, InputLog log, const ReplayManner& manner);

// Runs the session of an input log in real time, with the threads and the loop of a live one, and returns what all of
// it took; with a window, or without one (options.desk.offscreen). Files that the log asks for are not written.
// for_a_device: ticks are as punctual as a device's user needs them; otherwise as those of a simulated hand, which may
// rest.
[[nodiscard]] Result<SessionRecord> time_session(SessionSetup options, bool for_a_device);

// ---- The three kinds

// Options of a real-time run. The haptic loop may rest by default, since nobody feels the force on a simulated hand.
struct RealTimeRun {
    bool keep_frames = false;                  // keeps every frame and its times in the record
    haptics::LoopPace pace = {.rests = true};  // of what pace_of() allows
    std::optional<double>
        machine_pace{};  // haptics::WorkSettings::pace; none: it is measured before the session begins
    DirectDriver driver = direct_driver();
    SessionFacts facts{};  // of a session file
    LogNeeds needs{.pictures = true,
                   .panel = true};   // of the input; where nobody sees it and it needs less, there is less
    bool opens_before_eyes = false;  // a window shows the workpiece while it is made (desk/opening/)
};
// Returns the pace that was asked for, without rest where ticks are missed by somebody: an activity, whose clock and
// figures go by them, or a person who feels a device.
[[nodiscard]] haptics::LoopPace pace_of(haptics::LoopPace asked, bool felt_by_person, bool has_activity);
// Runs in real time: haptics and carving have threads of their own, and a frame is drawn when something has changed, as
// late as the display allows. Input comes from a user, or from a log in the user's place. Where options.record.path
// asks for it, it is recorded once the session has found out what the recording's first line has to hold. SIGINT and
// SIGTERM end the session as closing its window does; a second signal ends the program at once. Where its user ends it
// while the workpiece is still made, the record is empty. (real_time_session.cpp)
[[nodiscard]] Result<SessionRecord> run_in_real_time(const SessionSetup& options, const SessionWall& wall,
                                                     InputSource input, RealTimeRun run = {});

// Runs a script in simulated time: ticks, carving and frames follow one another on one thread, so that the same script
// gives the same frames, with or without a window. Offscreen it opens a graphics device for pictures that the script
// asks for, and lays out a panel for them and for mouse, keys or wands that may meet it: else neither.
// (session_frames.cpp)
[[nodiscard]] Result<void> run_in_simulated_time(const SessionSetup& options, const SessionWall& wall, InputLog log);

// Replays a session that was recorded in real time (the log has threads): every frame with what the threads had done by
// then, on one thread and as fast as the machine can. Fails at the end, after the last frame, when a result differs
// from the recording: with another program, other options, or an edited log; at once where the witness does.
// (recorded_session.cpp)
[[nodiscard]] Result<void> replay_as_recorded(const SessionSetup& options, const SessionWall& wall, InputLog log,
                                              const ReplayManner& manner = {});

}  // namespace burin::session
