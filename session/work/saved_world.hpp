// SPDX-License-Identifier: MIT
// The objects of a session's world as a part of its document. They are values that the frame has whole
// (session/objects/world_objects.hpp), so their pages are made there, and the scene's thread is not asked: which
// objects have changed since they were saved, their addresses say.
// Their steps of undo are values as well: which of them are new, the states say that they lead to.
// Thread: the frame's.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "scene/pages.hpp"
#include "session/objects/world_history.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::session {

class SavedWorld {
public:
    // Takes the objects, and what was done to them, as they are now; is_saved: the document has them so.
    void begin(const WorldObjects& now, const WorldHistory& edits, bool is_saved);

    // Returns the pages of all, or where `whole` is false of those that have changed since the last call, with the
    // steps that are new since then.
    [[nodiscard]] scene::Pages save(const WorldObjects& now, const WorldHistory& edits, bool whole);
    // Returns what has changed since the last call, with the steps that are new, for a journal; nothing where nothing
    // has.
    [[nodiscard]] std::optional<scene::Pages> take_change(const WorldObjects& now, const WorldHistory& edits);
    [[nodiscard]] bool has_change(const WorldObjects& now) const { return told_ != now.objects; }
    // Returns the pages of all for a journal that begins with them.
    [[nodiscard]] scene::Pages all(const WorldObjects& now, const WorldHistory& edits);

private:
    using Objects = std::vector<std::shared_ptr<const scene::SceneObject>>;
    using States = std::map<std::int64_t, std::uint64_t>;  // after each step
    [[nodiscard]] scene::Pages pages(const WorldObjects& now, const Objects* known) const;
    // Returns the steps, with the pages of those that are other than these states say.
    [[nodiscard]] scene::Steps steps(const WorldHistory& edits, const States& known) const;

    std::vector<std::size_t> meshes_;                                   // the number of each object's mesh
    std::vector<std::shared_ptr<const scene::CornerColours>> colours_;  // of each object's file
    Objects saved_, told_;                                              // in the document, and in the journal
    States saved_steps_, told_steps_;                                   // likewise
    std::uint64_t told_state_ = 0;                                      // of the objects, in the journal
};

}  // namespace burin::session
