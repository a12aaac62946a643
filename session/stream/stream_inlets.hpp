// SPDX-License-Identifier: MIT
// The streams of markers that a session hears: those that a predicate finds, each pulled with a timeout, its stamps
// brought to this machine's clock by the library's time correction. The session's own stream of events is never one of
// them: it would hear what it says. One thread, which waits in the library.
#pragma once

#include <string>
#include <vector>

#include "base/error.hpp"
#include "devices/lsl/lsl_api.hpp"

namespace burin::session {

inline constexpr std::size_t kMostMarkerStreams = 16;
inline constexpr std::int32_t kMostMarkerChannels = 32;

struct HeardMarker {
    double stamp_s = 0.0;  // on this machine's lsl_local_clock(), where it is corrected
    bool is_corrected = false;
    std::string stream, text;
};

class StreamInlets {
public:
    // `own_source` begins the identifiers of the session's own streams.
    [[nodiscard]] static Result<StreamInlets> open(const devices::LslApi& api, const std::string& predicate,
                                                   std::string own_source);
    ~StreamInlets();
    StreamInlets(StreamInlets&& other) noexcept;
    StreamInlets& operator=(StreamInlets&&) = delete;

    // Opens the streams that were found since; call it now and then.
    void look();
    // Returns how many streams of markers were found until now, with those that are not heard.
    [[nodiscard]] std::size_t found() const { return heard_.size(); }
    // Pulls what has come, and waits for it up to a time.
    [[nodiscard]] std::vector<HeardMarker> pull(double timeout_s);
    // Returns what there is to tell since the last call.
    [[nodiscard]] std::vector<std::string> take_messages();

private:
    struct Heard {
        std::string uid, name;
        std::int32_t channels = 1;
        devices::LslInlet inlet = nullptr;  // null: it is left out
        double correction_s = 0.0;
        bool is_corrected = false;
    };
    StreamInlets(const devices::LslApi& api, std::string own_source) : api_(api), own_source_(std::move(own_source)) {}
    void consider(devices::LslInfo info);
    void correct(Heard& heard, double timeout_s);
    void pull_from(Heard& heard, double timeout_s, std::vector<HeardMarker>& to);

    devices::LslApi api_;
    std::string own_source_;
    devices::LslResolver resolver_ = nullptr;
    std::vector<Heard> heard_;
    std::vector<std::string> messages_;
};

}  // namespace burin::session
