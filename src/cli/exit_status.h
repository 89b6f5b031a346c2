/// The program's exit status (contract, section 3).
#pragma once

namespace mobbscope::cli {

enum ExitStatus : int {
    kDone = 0,
    kFailed = 1,     ///< the comparison or check asked for failed
    kBadInput = 2,   ///< bad usage or bad input
    kNoMachine = 3,  ///< the machine lacks something: no GL, cannot write
};

}  // namespace mobbscope::cli
