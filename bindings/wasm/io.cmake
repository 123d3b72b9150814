# pliant-io: readers and writers, loaded only by those who read files.
add_executable(pliant_io_wasm
  bind_scratch.cpp
  bind_io.cpp
)
target_link_libraries(pliant_io_wasm PRIVATE pliant_io pliant_flags)
target_link_options(pliant_io_wasm PRIVATE ${PLIANT_MODULE_LINK_OPTIONS})
set_target_properties(pliant_io_wasm PROPERTIES OUTPUT_NAME pliant-io SUFFIX .mjs)
