// SPDX-License-Identifier: MIT
// The undo history of a document that is opened: what its solid held before each stroke, its objects before each edit,
// and in which order these were. Any thread.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "compute/engine/history.hpp"
#include "document/document_reader.hpp"
#include "scene/scene_object.hpp"
#include "session/objects/world_history.hpp"

namespace burin::session {

// Reads the history of the solid as its pages are, within so much memory: the newest steps. What is damaged ends it,
// and is added to `lost` in words.
[[nodiscard]] compute::History history_in(document::DocumentReader& reader, const document::PartPlace& part,
                                          const compute::Solid& solid, std::size_t undo_bytes, std::string& lost);

// Reads what was done to the objects, which have the colours of their files. What is damaged ends it, likewise.
[[nodiscard]] WorldHistory edits_in(document::DocumentReader& reader, const document::PartPlace& part,
                                    std::span<const scene::SceneObject> objects,
                                    std::span<const std::shared_ptr<const scene::CornerColours>> colours,
                                    std::string& lost);

// Returns what a history of strokes says of itself; none of them goes on.
[[nodiscard]] scene::PartSteps steps_of(const compute::History& history);

}  // namespace burin::session
