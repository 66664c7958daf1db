#pragma once

namespace mspskel::cli {

// Threads that spin while they wait for one another take the processor from the one that they wait for
// wherever something else runs. Asleep they cost a little on an idle machine and save a third of the time and
// more on a busy one. So the program has OMP_WAIT_POLICY=passive unless its environment says otherwise: to be
// called before the first parallel region.
void let_waiting_threads_sleep();

}  // namespace mspskel::cli
