#include <import/motion_warnings.h>
namespace mobbscope {
void add_motion_warnings(const mobb::Clip&, double, SourceFacts&) {}
}
