// The step that an error allows.
#pragma once

#include <functional>

namespace paim {

// The largest step with an error of at most `most`, of all from `smallest`, with which values fit in
// 16 bits, to the one of which the largest value is one. 0 if not even `smallest` is good; 1 if that
// is 0, for then all values are. What the step adds to the error of the smallest is within 1 % of
// what it may add, as far as errors are smooth; where the rough error of the smallest step is too
// large already, no other is tried.
// rough_error(step)  grows with the step, and about as the error does; asked often
// error(step)        at most rough_error; asked a few times
double largest_step(double smallest, double most, const std::function<double(double)>& rough_error,
                    const std::function<double(double)>& error);

}  // namespace paim
