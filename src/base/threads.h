/// Threads, where the system may refuse to start more.
#pragma once

namespace mobbscope {

/// How many threads this process has; 0 where the system does not tell.
int thread_count();

/// How many of `wanted` (>= 0) more threads the system lets this process start, found out by starting them for a
/// moment.
int startable_threads(int wanted);

/// To call before work is handed to TBB, whose own way out of a thread that cannot be started is an exception in the
/// midst of the work: it uses no more threads than can be started. Measured once.
void limit_worker_threads();

/// Ends the threads that TBB keeps, if none of them works; it starts them again when they are needed.
void end_worker_threads();

}  // namespace mobbscope
