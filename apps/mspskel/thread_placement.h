#pragma once

namespace mspskel::cli {

// Starts the threads of the parallel regions and keeps this one on its processor and the others off it. Where
// processors share no cache, as on many virtual machines, a thread that is woken is often put behind the one
// that woke it, and the two take turns for 10 ms: a quarter of a small mesh's time. Does nothing where the
// environment places threads (OMP_PROC_BIND), where there are not as many threads as processors, and on
// systems other than Linux. Cost: a tenth of a millisecond.
void keep_threads_apart(int threads);

}  // namespace mspskel::cli
