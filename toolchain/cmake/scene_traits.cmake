# -DGODOBJECT_SCENE=X.cmake, written by `godobject-scenec SCENE.toml -o X.scene --traits X.cmake`: build for that scene,
# without what it does not need. The file sets
#   GODOBJECT_SCENE_SOLVERS   those that the scene image holds: contact, corrected, paper
#   GODOBJECT_SCENE_FRICTION  ON where the scene has friction
#   GODOBJECT_SCENE_FEATURES  ON where the image holds the second direction
#   GODOBJECT_SCENE_EDGES     ON where the image holds sharp edges of both bodies
#   GODOBJECT_SCENE_POINTS    OFF where contact needs none but the centre of a ball without friction
# From them comes GODOBJECT_LEFT_OUT, the compile definitions of core/pipeline/cycle/scene_traits.h; empty: all is built.
set(GODOBJECT_SCENE "" CACHE FILEPATH "Build for one scene: its traits, from godobject-scenec --traits")

set(GODOBJECT_LEFT_OUT "")
if(GODOBJECT_SCENE)
  include("${GODOBJECT_SCENE}")
  set(SOLVERS paper corrected contact)
  foreach(trait SOLVERS FRICTION FEATURES EDGES POINTS)
    if(NOT DEFINED GODOBJECT_SCENE_${trait})
      message(FATAL_ERROR "${GODOBJECT_SCENE}: does not set GODOBJECT_SCENE_${trait}; "
        "make it with godobject-scenec SCENE.toml -o X.scene --traits X.cmake")
    endif()
  endforeach()
  foreach(solver IN LISTS GODOBJECT_SCENE_SOLVERS)
    if(NOT solver IN_LIST SOLVERS)
      message(FATAL_ERROR "${GODOBJECT_SCENE}: GODOBJECT_SCENE_SOLVERS: there is no solver ${solver}")
    endif()
  endforeach()
  foreach(solver IN LISTS SOLVERS)
    string(TOUPPER "${solver}" upper)
    if(NOT solver IN_LIST GODOBJECT_SCENE_SOLVERS)
      list(APPEND GODOBJECT_LEFT_OUT GODOBJECT_NO_${upper})
    endif()
  endforeach()
  foreach(trait FRICTION FEATURES EDGES POINTS)
    if(NOT GODOBJECT_SCENE_${trait})
      list(APPEND GODOBJECT_LEFT_OUT GODOBJECT_NO_${trait})
    endif()
  endforeach()
  message(STATUS "Built for the scene of ${GODOBJECT_SCENE}; left out: ${GODOBJECT_LEFT_OUT}")
endif()
