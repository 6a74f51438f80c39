# execute_process() that ends the test where the command does not end as expected.
function(run)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE result)
  if(NOT result EQUAL 0)
    message(FATAL_ERROR "failed (${result}): ${ARGV}")
  endif()
endfunction()
# configure(consumer prefix argument...): from a copy, so that nothing of the source tree can be found by a relative path.
function(configure consumer prefix)
  file(COPY ${CONSUMER_FOLDER}/${consumer} DESTINATION ${WORK_FOLDER})
  run(${CMAKE_COMMAND} -S ${WORK_FOLDER}/${consumer} -B ${WORK_FOLDER}/${consumer}/build -G ${GENERATOR}
      -DCMAKE_PREFIX_PATH=${prefix} -DCMAKE_BUILD_TYPE=Release -DCMAKE_CXX_FLAGS_RELEASE=-O0 -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER} ${ARGN})
endfunction()
function(build_and_run consumer)
  run(${CMAKE_COMMAND} --build ${WORK_FOLDER}/${consumer}/build)
  run(${WORK_FOLDER}/${consumer}/build/consumer)
endfunction()

file(REMOVE_RECURSE ${WORK_FOLDER})
set(everything ${WORK_FOLDER}/everything)
run(${CMAKE_COMMAND} --install ${BUILD_FOLDER} --prefix ${everything})
configure(sculpt_consumer ${everything} -DCGAL_DIR=${CGAL_DIR})
build_and_run(sculpt_consumer)
# The device does without CGAL: from an installation of everything, and when nothing else is configured and installed.
set(no_cgal -DCMAKE_DISABLE_FIND_PACKAGE_CGAL=ON)
configure(device_consumer ${everything} ${no_cgal})
file(REMOVE_RECURSE ${WORK_FOLDER}/device_consumer)
set(device_only ${WORK_FOLDER}/device_only)
run(${CMAKE_COMMAND} -S ${SOURCE_FOLDER} -B ${WORK_FOLDER}/device_build -G ${GENERATOR} -DHAPTIC_SCULPT_DEVICE_ONLY=ON ${no_cgal}
    -DCMAKE_CXX_COMPILER=${CMAKE_CXX_COMPILER})
run(${CMAKE_COMMAND} --install ${WORK_FOLDER}/device_build --prefix ${device_only})
configure(device_consumer ${device_only} ${no_cgal})
build_and_run(device_consumer)
# Who asks such an installation for more is told what is missing.
execute_process(COMMAND ${CMAKE_COMMAND} -S ${WORK_FOLDER}/sculpt_consumer -B ${WORK_FOLDER}/refused -G ${GENERATOR}
  -DCMAKE_PREFIX_PATH=${device_only} RESULT_VARIABLE result ERROR_VARIABLE message OUTPUT_QUIET)
string(REGEX REPLACE "[ \n]+" " " message "${message}")
if(result EQUAL 0 OR NOT message MATCHES "Only the device is installed here")
  message(FATAL_ERROR "an installation of the device alone serves for more, or does not say why not: ${message}")
endif()
