/* Embeds Paim from C: the same as play.cpp, with the bytes of the file in memory. */
#include "paim/paim.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int fail(paim_status status) {
    fprintf(stderr, "%s\n", paim_error_message());
    return (int)status;
}

static void* read_all(const char* file, size_t* size) {
    FILE* stream = fopen(file, "rb");
    if (stream == NULL) return NULL;
    fseek(stream, 0, SEEK_END);
    *size = (size_t)ftell(stream);
    rewind(stream);
    void* bytes = malloc(*size + 1);
    if (bytes != NULL) *size = fread(bytes, 1, *size, stream);
    fclose(stream);
    return bytes;
}

/* The three numbers that play.cpp prints. */
static int play(const paim_asset* asset, paim_player* player) {
    paim_asset_info info;
    paim_part_info part;
    paim_asset_get_info(asset, &info);
    paim_asset_get_part(asset, 0, &part);
    const size_t num_floats = 3 * (size_t)part.num_vertices;
    float* xyz = malloc(num_floats * sizeof(float));
    float* rgb = malloc(num_floats * sizeof(float));

    /* Radiance 1 from everywhere is y_00 alone: its integral over the sphere, sqrt(4 pi). */
    const float l00 = 3.5449077f;
    const float light[3] = {l00, l00, l00};
    paim_status status = paim_player_set_light(player, light, 1);
    if (!status) status = paim_player_update(player, 0.5 * (info.num_poses - 1), NULL);
    if (!status) status = paim_player_copy_positions(player, 0, xyz, num_floats);
    if (!status) status = paim_player_copy_radiance(player, 0, rgb, num_floats);
    if (status) return fail(status);

    float lowest[3] = {rgb[0], rgb[1], rgb[2]}, highest[3] = {rgb[0], rgb[1], rgb[2]};
    double sum = 0.0;
    for (size_t i = 0; i < num_floats; ++i) {
        lowest[i % 3] = fminf(lowest[i % 3], rgb[i]);
        highest[i % 3] = fmaxf(highest[i % 3], rgb[i]);
        sum += xyz[i];
    }
    printf("paim %s: %u vertices, %u poses, %u bands\n", paim_version(), part.num_vertices,
           info.num_poses, part.num_bands);
    printf("radiance %.4f %.4f %.4f to %.4f %.4f %.4f\n", lowest[0], lowest[1], lowest[2],
           highest[0], highest[1], highest[2]);
    printf("positions sum to %.4f\n", sum);
    free(xyz);
    free(rgb);
    return 0;
}

int main(int argc, char** argv) {
    const int prefix = argc == 3 && strcmp(argv[1], "--prefix") == 0;
    if (argc != 2 && !prefix) {
        fprintf(stderr, "usage: paim_play_c [--prefix] X.paim\n");
        return 1;
    }
    size_t size = 0;
    const char* file = argv[argc - 1];
    void* bytes = read_all(file, &size);
    paim_asset* asset = NULL;
    paim_player* player = NULL;
    paim_status status = prefix ? paim_asset_open_prefix(bytes, size, file, &asset)
                                : paim_asset_open_memory(bytes, size, file, &asset);
    free(bytes);
    if (!status) status = paim_player_create(asset, &player);
    const int result = status ? fail(status) : play(asset, player);
    paim_player_destroy(player);
    paim_asset_close(asset);
    return result;
}
