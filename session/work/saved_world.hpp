// SPDX-License-Identifier: MIT
// The objects of a session's world as a part of its document. They are values that the frame has whole
// (session/objects/world_objects.hpp), so their pages are made there, and the scene's thread is not asked: which
// objects have changed since they were saved, their addresses say.
// Thread: the frame's.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "scene/pages.hpp"
#include "session/objects/world_objects.hpp"

namespace burin::session {

class SavedWorld {
public:
    // Takes the objects as they are now; is_saved: the document has them so.
    void begin(const WorldObjects& now, bool is_saved);

    // Returns the pages of all, or where `whole` is false of those that have changed since the last call.
    [[nodiscard]] scene::Pages save(const WorldObjects& now, bool whole);
    // Returns what has changed since the last call, for a journal; nothing where nothing has.
    [[nodiscard]] std::optional<scene::Pages> take_change(const WorldObjects& now);
    [[nodiscard]] bool has_change(const WorldObjects& now) const { return told_ != now.objects; }
    // Returns the pages of all for a journal that begins with them.
    [[nodiscard]] scene::Pages all(const WorldObjects& now);

private:
    using Objects = std::vector<std::shared_ptr<const scene::SceneObject>>;
    [[nodiscard]] scene::Pages pages(const WorldObjects& now, const Objects* known) const;

    std::vector<std::size_t> meshes_;                                   // the number of each object's mesh
    std::vector<std::shared_ptr<const scene::CornerColours>> colours_;  // of each object's file
    Objects saved_, told_;                                              // in the document, and in the journal
};

}  // namespace burin::session
