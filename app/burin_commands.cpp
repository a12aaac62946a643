// SPDX-License-Identifier: MIT
#include "app/burin_commands.hpp"

#include "app/bench/bench_command.hpp"
#include "app/bench/profile.hpp"
#include "app/carve/sculpt.hpp"
#include "app/demo_command.hpp"
#include "app/devices/devices_command.hpp"
#include "app/devices/glove_command.hpp"
#include "app/meshes/combine.hpp"
#include "app/meshes/convert.hpp"
#include "app/meshes/document_command.hpp"
#include "app/recordings/film_command.hpp"
#include "app/recordings/replay_command.hpp"
#include "app/recordings/session_command.hpp"
#include "app/rehab/rehab_command.hpp"
#include "app/study/study_command.hpp"
#include "app/walls/wall_commands.hpp"
#include "app/world/hand_command.hpp"
#include "app/world/seek_command.hpp"
#include "app/world/world_command.hpp"

namespace burin::app {

std::vector<CommandRow> burin_commands() {
    return {sculpt_row(),  convert_row(), info_row(),    combine_row(), hand_row(),  film_row(),
            seek_row(),    bench_row(),   wall_row(),    world_row(),   demo_row(),  profile_row(),
            session_row(), replay_row(),  devices_row(), glove_row(),   study_row(), rehab_row()};
}

}  // namespace burin::app
