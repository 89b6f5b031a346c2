# What a run said of a case that did not pass, its first word the outcome; nothing of one that passed.
if(EXISTS "${FILE}")
  execute_process(COMMAND ${CMAKE_COMMAND} -E cat "${FILE}")
endif()
