# What a folder must not include even from outside the repository. The folders that a folder may include are declared in
# its own CMakeLists.txt (burin_folder's MAY_INCLUDE); both are read by the test house.layers.
#   burin_forbid(FOLDER prefix...)  a prefix is compared with the text between < > or " ", also in headers reached
#                                   through other folders; "vulkan" forbids <vulkan/vulkan.h>, "fstream" <fstream>
function(burin_forbid FOLDER)
  string(REPLACE ";" " " prefixes "${ARGN}")
  set_property(GLOBAL APPEND PROPERTY BURIN_FORBIDDEN_HEADERS "${FOLDER}: ${prefixes}")
endfunction()

set(vulkan_headers vulkan volk)
# The 1 kHz tick: no Vulkan, no file, no log, no lock. (That the tick itself allocates, locks and throws nothing is
# counted by its own tests; this rule keeps the headers away.)
burin_forbid(haptics ${vulkan_headers} spdlog fmt fstream iostream sstream cstdio stdio.h filesystem fcntl.h
  mutex shared_mutex condition_variable regex)
# Only gpu, and those above it, know Vulkan.
burin_forbid(base ${vulkan_headers})
burin_forbid(geometry ${vulkan_headers} thread future)
burin_forbid(devices ${vulkan_headers})
burin_forbid(wall ${vulkan_headers})
burin_forbid(picture ${vulkan_headers})
burin_forbid(study ${vulkan_headers})
burin_forbid(scene ${vulkan_headers})
burin_forbid(bodies ${vulkan_headers} thread future)
burin_forbid(record ${vulkan_headers})
burin_forbid(document ${vulkan_headers})
burin_forbid(toolbox ${vulkan_headers})
burin_forbid(workpiece ${vulkan_headers})
burin_forbid(sculpt ${vulkan_headers})
burin_forbid(session ${vulkan_headers})
burin_forbid(shaders/shared ${vulkan_headers} iostream fstream)
# Only window/ knows the window library. (desk reaches windows through its headers, which show nothing of it.)
foreach(folder base geometry devices haptics scene record document wall picture gpu compute renderer toolbox
    workpiece sculpt bodies session desk study activities bench app)
  burin_forbid(${folder} GLFW)
endforeach()
# Only desk/panel/ knows the panel's toolkit; the renderer paints plain triangles.
foreach(folder base geometry devices haptics scene record document wall picture gpu compute renderer window toolbox
    workpiece sculpt bodies session study activities bench app)
  burin_forbid(${folder} imgui)
endforeach()
