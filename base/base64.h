/* Bytes as base64 (RFC 4648 sec. 4), for pages that hold their own pictures. */
#pragma once

#include <stddef.h>
#include <stdint.h>
#include <stdio.h>

/** Whole groups of three bytes may be followed by more. */
void base64_write(const uint8_t *bytes, size_t n, FILE *out);

/**
 * A data URL (RFC 2397).
 * @param type  "image/png"
 * @return its text, to be freed with free(); NULL: out of memory (reported)
 */
char *base64_url(const char *type, const uint8_t *bytes, size_t n);
