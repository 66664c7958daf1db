#include "wait_policy.h"

#include <cstdlib>

#if defined(__GNUC__) && !defined(__clang__) && defined(__ELF__)
#define MSPSKEL_EARLY_ENVIRONMENT
#endif

namespace mspskel::cli {
namespace {

#ifdef MSPSKEL_EARLY_ENVIRONMENT

char policy[] = "OMP_WAIT_POLICY=passive";
char** lent_slot = nullptr;
char* lender = nullptr;

__attribute__((no_sanitize("address", "thread", "undefined"))) bool starts_with(const char* text,
                                                                                const char* start) {
  while (*start != '\0')
    if (*text++ != *start++) return false;
  return true;
}

// GNU's OpenMP reads the variable while the loader initialises the libraries, before main. What stands in
// .preinit_array runs earlier still, but the environment cannot grow then: libc sets it up afterwards. So
// some other variable lends its place until main. To start the program anew costs 2 ms, a tenth of a small
// mesh.
__attribute__((no_sanitize("address", "thread", "undefined"))) void lend(int, char**, char** environment) {
  char** slot = nullptr;
  for (char** variable = environment; *variable != nullptr; ++variable) {
    if (starts_with(*variable, "OMP_WAIT_POLICY=") || starts_with(*variable, "GOMP_SPINCOUNT=")) return;
    if (!starts_with(*variable, "OMP_") && !starts_with(*variable, "GOMP_")) slot = variable;
  }
  if (slot == nullptr) return;
  lent_slot = slot;
  lender = *slot;
  *slot = policy;
}

__attribute__((section(".preinit_array"), used)) void (*const lend_early)(int, char**, char**) = lend;

#endif

}  // namespace

void let_waiting_threads_sleep() {
#ifdef MSPSKEL_EARLY_ENVIRONMENT
  if (lent_slot != nullptr && *lent_slot == policy) *lent_slot = lender;
  lent_slot = nullptr;
#else
  // LLVM's OpenMP reads the variable when it first has something to do.
  if (std::getenv("GOMP_SPINCOUNT") == nullptr) setenv("OMP_WAIT_POLICY", "passive", 0);
#endif
}

}  // namespace mspskel::cli
