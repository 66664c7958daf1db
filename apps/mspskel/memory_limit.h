// --max-memory: a program that needs more ends with a word instead of making the machine swap.
#pragma once

#include <string>

namespace mspskel::cli {

// From here on the process gets no more than so many megabytes (10^6 bytes) of memory of its own; 0 sets no
// limit. So many threads are started before, since OpenMP ends the process where it can start none. What does
// not fit throws std::bad_alloc. Throws UsageError if the process has more already, or where the system knows
// no such limit.
void limit_memory(double megabytes, int threads);

// What to say where memory is short: names the limit if there is one.
std::string out_of_memory_text();
bool memory_is_limited();

}  // namespace mspskel::cli
