/* Paim for C and for every language that can call it: opens a .paim file, plays it, and copies positions
 * and radiance into the caller's memory.
 *
 * Every function that can fail returns a paim_status; paim_error_message() says what went wrong, where,
 * what was expected and what was got. No file contents end the process.
 *
 * Threads: an asset never changes and may be used by any number of threads. A player is used by one
 * thread at a time. Messages belong to the thread whose call failed.
 *
 * Conventions: right-handed, +Y up; radiance is linear RGB; spherical harmonics are real, coefficient
 * i = l (l + 1) + m (docs/conventions.md). Sizes are counts of elements, not bytes.
 */
#ifndef PAIM_PAIM_H
#define PAIM_PAIM_H

#include <stddef.h>
#include <stdint.h>

#include "paim/base/export.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef enum paim_status {
    PAIM_OK = 0,
    PAIM_BAD_ARGUMENT =
        1,                /* a null pointer, a number out of range, or a buffer of the wrong size */
    PAIM_BAD_INPUT = 2,   /* the file is missing, damaged or inconsistent */
    PAIM_UNSUPPORTED = 3, /* valid, but not something this version can read */
    PAIM_OUT_OF_MEMORY = 4,
    PAIM_FAILED = 5 /* anything else; the message says what */
} paim_status;

/* A .paim file in memory. */
typedef struct paim_asset paim_asset;
/* Plays an asset, with scratch memory of its own. */
typedef struct paim_player paim_player;

typedef struct paim_asset_info {
    uint32_t num_parts;      /* at least 1: part 0 moves, others may be still */
    uint32_t num_poses;      /* at least 1 */
    float frames_per_second; /* poses per second */
    double origin[3];        /* adding it to positions, in double, gives scene coordinates */
} paim_asset_info;

typedef struct paim_part_info {
    uint32_t num_vertices;
    uint32_t num_triangles;
    uint32_t num_bands;     /* of light, at most 64: the more of transfer and gloss */
    uint32_t num_channels;  /* of transfer: 1 grey, 3 coloured */
    uint32_t num_glossy;    /* vertices whose radiance depends on the eye; 0: none */
    uint32_t num_out_bands; /* of their outgoing radiance; 0: none */
} paim_part_info;

/* Where a part stands in the scene. */
typedef struct paim_root {
    double rotation[4];    /* unit quaternion w, x, y, z */
    double translation[3]; /* scene units */
    /* Vertices, from the first, that follow this transform. The others are a floor, or have no face: their
     * local coordinates are those of the scene. */
    uint32_t num_following;
} paim_root;

/* How much of the file to use; larger numbers than it has mean all. paim_no_limits() sets every member
 * to the largest number. */
typedef struct paim_limits {
    uint32_t geometry_components;
    uint32_t transfer_components;
    uint32_t bands;             /* at least 1 is used */
    uint32_t vertex_components; /* of codecs whose vertices share bases */
    uint32_t gloss_components;  /* the same of gloss */
    uint32_t gloss_vertex_components;
} paim_limits;

/* "MAJOR.MINOR.PATCH" */
PAIM_EXPORT const char* paim_version(void);

/* Of the last call of this thread that failed; never null. Valid until its next call that fails. */
PAIM_EXPORT const char* paim_error_message(void);

/* Opens a file, or bytes of one, which are not kept. *asset is null unless PAIM_OK is returned.
 * name  what messages call the bytes */
PAIM_EXPORT paim_status paim_asset_open_file(const char* path, paim_asset** asset);
PAIM_EXPORT paim_status paim_asset_open_memory(const void* bytes, size_t num_bytes,
                                               const char* name, paim_asset** asset);
/* The same for a prefix of a file, such as the part of it that has been loaded so far. The asset has the
 * components that the prefix holds. If it is too short to be played, the result is PAIM_BAD_INPUT, and
 * the message says how many bytes are needed. */
PAIM_EXPORT paim_status paim_asset_open_prefix(const void* bytes, size_t num_bytes,
                                               const char* name, paim_asset** asset);
/* Players of the asset go on working. Null is allowed. */
PAIM_EXPORT void paim_asset_close(paim_asset* asset);

PAIM_EXPORT paim_status paim_asset_get_info(const paim_asset* asset, paim_asset_info* info);
PAIM_EXPORT paim_status paim_asset_get_part(const paim_asset* asset, uint32_t part,
                                            paim_part_info* info);
/* indices  [num_triangles][3], counter-clockwise from outside; num_indices is that product */
PAIM_EXPORT paim_status paim_asset_copy_triangles(const paim_asset* asset, uint32_t part,
                                                  uint32_t* indices, size_t num_indices);

PAIM_EXPORT paim_status paim_player_create(const paim_asset* asset, paim_player** player);
/* Null is allowed. */
PAIM_EXPORT void paim_player_destroy(paim_player* player);

PAIM_EXPORT paim_limits paim_no_limits(void);

/* Lights all parts from infinitely far away, from the next update on.
 * rgb  [num_bands * num_bands][3] radiance coefficients; num_bands 1 to 64 */
PAIM_EXPORT paim_status paim_player_set_light(paim_player* player, const float* rgb,
                                              uint32_t num_bands);
/* Where glossy surfaces are seen from, from the next update on. Without an eye, as at first, radiance is
 * that of the diffuse reflection alone.
 * xyz  scene units, relative to the asset's origin; null: no eye. PAIM_BAD_ARGUMENT unless finite */
PAIM_EXPORT paim_status paim_player_set_eye(paim_player* player, const float* xyz);
/* Shows the moment `time` in poses, 0 to num_poses - 1, clamped; fractions lie between two poses. Only
 * what changed since the last update is computed again.
 * limits  null: everything */
PAIM_EXPORT paim_status paim_player_update(paim_player* player, double time,
                                           const paim_limits* limits);
/* Results of the last update. xyz, rgb  [num_vertices][3]; num_floats is that product.
 * radiance  towards the eye if there is one. PAIM_BAD_ARGUMENT if no light was set before the update; may
 *           be slightly negative where the light's spherical harmonics ring */
PAIM_EXPORT paim_status paim_player_copy_positions(const paim_player* player, uint32_t part,
                                                   float* xyz, size_t num_floats);
/* Positions before the part was moved to its place, for bodies that travel so far that floats of the
 * scene are too coarse for their shape: scene = rotation * local + translation. */
PAIM_EXPORT paim_status paim_player_copy_local_positions(const paim_player* player, uint32_t part,
                                                         float* xyz, size_t num_floats);
PAIM_EXPORT paim_status paim_player_get_root(const paim_player* player, uint32_t part,
                                             paim_root* root);
PAIM_EXPORT paim_status paim_player_copy_radiance(const paim_player* player, uint32_t part,
                                                  float* rgb, size_t num_floats);

#ifdef __cplusplus
}
#endif

#endif
