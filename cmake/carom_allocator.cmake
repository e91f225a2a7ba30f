# SPDX-License-Identifier: MIT
# carom_fast_allocator(<target>): the program allocates with mimalloc, where it is installed, as all libraries do that it
# loads. A program's choice, and none of a library's. Sanitizers bring an allocator of their own.
find_package(mimalloc QUIET)

function(carom_fast_allocator target)
  if(mimalloc_FOUND AND NOT CAROM_SANITIZE AND NOT CAROM_SANITIZE_THREADS)
    # before all other libraries; nothing of it is called by name
    target_link_libraries(${target} PRIVATE -Wl,--push-state,--no-as-needed mimalloc -Wl,--pop-state)
  endif()
endfunction()
