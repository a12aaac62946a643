// SPDX-License-Identifier: MIT
// What whoever owns a scene orders of it between two updates. One thread gives an order, one carries it out.
#pragma once

#include <concepts>
#include <functional>
#include <type_traits>
#include <utility>

namespace burin::scene {

// What is to be carried out just before an update, and whether it is among the orders of that update: those change what
// is touched or shown, and a replay of the update gives them again. One aside reads what there is, for a journal that
// is kept beside the session, and a replay has none.
class SceneOrder {
public:
    template <typename Run>
        requires std::invocable<Run&> && (!std::same_as<std::remove_cvref_t<Run>, SceneOrder>)
    SceneOrder(Run run) : run_(std::move(run)) {}  // implicit: a function is an order
    [[nodiscard]] static SceneOrder aside(std::function<void()> run) {
        SceneOrder order(std::move(run));
        order.counts_ = false;
        return order;
    }
    void operator()() const { run_(); }
    [[nodiscard]] bool counts() const { return counts_; }

private:
    std::function<void()> run_;
    bool counts_ = true;
};

}  // namespace burin::scene
