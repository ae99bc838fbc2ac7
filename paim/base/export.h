// PAIM_EXPORT marks the symbols that a shared libpaim_runtime exports; all others are hidden.
#pragma once

// PAIM_SHARED is defined only where the shared library is built or linked, so that a program or
// plugin that contains the static library exports none of its symbols.
#if defined(PAIM_SHARED)
#define PAIM_EXPORT __attribute__((visibility("default")))
#else
#define PAIM_EXPORT
#endif
