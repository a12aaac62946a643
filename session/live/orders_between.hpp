// SPDX-License-Identifier: MIT
// What a step of a session asks for between its orders for the workpiece: steps back and forward of any part, saves.
// Each comes after just so many of these orders as it was asked for after. Thread: the frame's.
#pragma once

#include <cstddef>

#include "session/live/work_side.hpp"
#include "session/state/session_orders.hpp"

namespace burin::session {

class OrdersBetween {
public:
    // All must outlive it.
    OrdersBetween(const SessionOrders& orders, SceneSide& scene, WorkSide& work, const SessionState& state,
                  const SceneSide::Give& give)
        : orders_(orders), scene_(scene), work_(work), state_(state), give_(give) {}

    // Gives those that were asked for after so many orders for the workpiece, or fewer.
    void give_up_to(std::size_t carving) {
        for (; saved_ < orders_.saves.size() && orders_.saves[saved_].after <= carving; ++saved_) {
            go_up_to(carving, orders_.saves[saved_].after_goes);
            work_.save(orders_.saves[saved_], state_, give_);
        }
        go_up_to(carving, orders_.goes.size());
    }

private:
    void go_up_to(std::size_t carving, std::size_t most_goes) {
        for (; gone_ < most_goes && orders_.goes[gone_].after <= carving; ++gone_)
            give_(scene_.going(orders_.goes[gone_].part, orders_.goes[gone_].way));
    }

    const SessionOrders& orders_;
    SceneSide& scene_;
    WorkSide& work_;
    const SessionState& state_;
    const SceneSide::Give& give_;
    std::size_t saved_ = 0, gone_ = 0;  // so many have been given
};

}  // namespace burin::session
