// Marks what a shared libpaim_runtime shows; everything else in it is hidden.
#pragma once

// Defined for those who build or link the shared library only, so that a program or plugin that has
// the static one inside shows nothing of it.
#if defined(PAIM_SHARED)
#define PAIM_EXPORT __attribute__((visibility("default")))
#else
#define PAIM_EXPORT
#endif
