# Warnings for our own targets only.
function(mspskel_target_warnings target)
  target_compile_options(${target} PRIVATE -Wall -Wextra -Wpedantic -Wshadow -Wconversion)
  # clang's -Wconversion includes sign conversion, which Eigen's signed and std::vector's unsigned indices make useless.
  # g++ takes OpenMesh's vectors, which leave their coordinates unset on purpose, for a mistake.
  target_compile_options(${target} PRIVATE -Wno-sign-conversion $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
endfunction()
