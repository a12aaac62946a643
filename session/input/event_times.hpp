
namespace burin::session {

class EventTimes {
public:
    // The longest time between two reports of a mouse that moves, and the shortest rest.
    static constexpr Nanoseconds kReport_ns = 16'000'000, kRest_ns = 50'000'000;
    // A wait that was shorter found events that lay ready.
    static constexpr Nanoseconds kAtOnce_ns = 1'000'000;

    // Returns the events of one look with their times. asked_ns: when the wait for them began; now_ns: when it ended.
    [[nodiscard]] std::vector<InputEvent> timed(std::vector<Input> told, Nanoseconds asked_ns, Nanoseconds now_ns);

private:
    Nanoseconds looked_ns_ = 0;        // when the look before ended
    std::optional<InputEvent> mouse_;  // its last motion
};

}  // namespace burin::session
