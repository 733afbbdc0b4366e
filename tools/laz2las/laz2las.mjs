#!/usr/bin/env node
// SPDX-FileCopyrightText: The scarp developers
// SPDX-License-Identifier: GPL-3.0-or-later
//
// node laz2las.mjs IN.laz OUT.las
//
// Turns LAZ or COPC into plain LAS: the same header, records and points, without the records that describe the
// compression and the COPC octree. Decoding is done by the package laz-perf (WebAssembly), which wants the whole
// file in its memory; the points leave in blocks.
//
// Exit codes: 0 done; 2 the file cannot be converted (one line "laz2las: why" on standard error); 3 the package is
// missing. OUT appears under its name only when it is whole.

import fs from 'node:fs';
import { createRequire } from 'node:module';

const BLOCK = 4 << 20; // bytes per read and write
const LARGEST = 1.9e9; // bytes; the WebAssembly memory ends at 2 GiB
const VLR = 54; // bytes of a variable length record before its payload
const EVLR = 60; // and of an extended one
const COMPRESSORS = ['none', 'point by point', 'in chunks', 'in layers'];

class Refusal extends Error {}

function loadPackage() {
  try {
    return createRequire(import.meta.url)('laz-perf');
  } catch (error) {
    if (error.code !== 'MODULE_NOT_FOUND') throw error;
    process.stderr.write('laz2las: the package laz-perf is missing; run npm ci in the folder of this program\n');
    process.exit(3);
  }
}

const text = (bytes, at, length) => bytes.toString('latin1', at, at + length).split('\0')[0];

function readAt(file, at, length) {
  const bytes = Buffer.alloc(length);
  for (let done = 0; done < length; ) {
    const got = fs.readSync(file, bytes, done, length - done, at + done);
    if (got === 0) throw new Refusal(`truncated at byte ${at + done}`);
    done += got;
  }
  return bytes;
}

function writeAll(file, bytes) {
  for (let done = 0; done < bytes.length; ) done += fs.writeSync(file, bytes, done, bytes.length - done);
}

/** The header's fields that matter here, and its variable length records. */
function readHead(file, size) {
  if (size < 227) throw new Refusal('truncated: shorter than a LAS header');
  const start = readAt(file, 0, 227);
  if (text(start, 0, 4) !== 'LASF') throw new Refusal('not a LAS file');
  const minor = start[25];
  const headerSize = start.readUInt16LE(94);
  const dataAt = start.readUInt32LE(96);
  if (headerSize < (minor >= 4 ? 375 : 227) || dataAt < headerSize || dataAt > size)
    throw new Refusal('damaged header: sizes do not fit the file');
  if ((start[104] & 0xc0) === 0) throw new Refusal('not compressed: it is plain LAS already');
  const head = readAt(file, 0, dataAt);
  const wide = minor >= 4 ? head.readBigUInt64LE(247) : 0n;
  return {
    minor,
    dataAt,
    header: head.subarray(0, headerSize),
    records: splitRecords(head, headerSize),
    format: head[104] & 0x3f,
    length: head.readUInt16LE(105),
    count: Number(wide > 0n ? wide : BigInt(head.readUInt32LE(107))),
  };
}

function splitRecords(head, headerSize) {
  const records = [];
  const promised = head.readUInt32LE(100);
  for (let at = headerSize; records.length < promised && at + VLR <= head.length; ) {
    const end = at + VLR + head.readUInt16LE(at + 20);
    if (end > head.length) throw new Refusal(`damaged variable length record at byte ${at}`);
    records.push(head.subarray(at, end));
    at = end;
  }
  return records;
}

/** What the LASzip record says, for a helpful message and to bound the number of points. */
function readCompression(las) {
  const record = las.records.find((r) => text(r, 2, 16) === 'laszip encoded' && r.readUInt16LE(18) === 22204);
  if (!record || record.length < VLR + 34) throw new Refusal('compressed, but without a LASzip record');
  const at = VLR;
  const kind = record.readUInt16LE(at);
  return {
    kind,
    chunk: record.readUInt32LE(at + 12),
    words:
      `LASzip ${record[at + 4]}.${record[at + 5]}, compressed ${COMPRESSORS[kind] ?? `in way ${kind}`}, ` +
      `point format ${las.format}`,
  };
}

/** A count that the chunks cannot hold would be decoded from what lies behind them. */
function checkCount(file, size, las, compression) {
  if (compression.chunk === 0xffffffff || las.count === 0) return; // chunks of any length, each with its count
  if (las.dataAt + 8 > size) throw new Refusal('truncated: no points');
  const table = Number(readAt(file, las.dataAt, 8).readBigInt64LE(0));
  if (table < las.dataAt + 8 || table + 8 > size) throw new Refusal('truncated: the table of chunks is missing');
  const chunks = readAt(file, table, 8).readUInt32LE(4);
  if (chunks * las.length > size || las.count > chunks * compression.chunk)
    throw new Refusal(`damaged: ${las.count} points promised in ${chunks} chunks of ${compression.chunk}`);
}

/** The message of a C++ exception: laz-perf throws the address of one, whose second word points to its text. */
function reasonOf(error, perf) {
  const address = parseInt(String(error?.message ?? error), 10);
  if (!(address > 0 && address + 8 <= perf.HEAPU8.length)) return String(error?.message ?? error).split('\n')[0];
  const at = new DataView(perf.HEAPU8.buffer).getUint32(address + 4, true);
  const words = Buffer.from(perf.HEAPU8.subarray(at, at + 200)).toString('latin1').split('\0')[0];
  const isSentence = /^[\x20-\x7e]+ [\x20-\x7e]+$/.test(words);
  return isSentence ? words : 'the compressed data is damaged or of an unknown kind';
}

async function openDecoder(file, size, las, createLazPerf) {
  if (size > LARGEST) throw new Refusal(`too large: ${size} bytes; at most ${LARGEST}`);
  // Quiet: what is wrong is said once, by us.
  const perf = await createLazPerf({ print() {}, printErr() {} });
  const place = perf._malloc(size);
  if (place === 0) throw new Refusal(`not enough memory for ${size} bytes`);
  for (let at = 0; at < size; at += BLOCK)
    perf.HEAPU8.set(readAt(file, at, Math.min(BLOCK, size - at)), place + at);
  const decoder = new perf.LASZip();
  try {
    decoder.open(place, size);
  } catch (error) {
    throw new Refusal(reasonOf(error, perf));
  }
  if (decoder.getPointLength() !== las.length) throw new Refusal('damaged: two lengths of a point record');
  return { perf, decoder };
}

/** Header and records of the plain file; `evlrs` extended records will follow the points. */
function plainHead(las, evlrs) {
  const kept = las.records.filter((r) => !['laszip encoded', 'copc'].includes(text(r, 2, 16)));
  const header = Buffer.from(las.header);
  const dataAt = kept.reduce((sum, r) => sum + r.length, header.length);
  header.writeUInt32LE(dataAt, 96);
  header.writeUInt32LE(kept.length, 100);
  header[104] = las.format;
  if (las.minor >= 4) {
    header.writeBigUInt64LE(evlrs > 0 ? BigInt(dataAt) + BigInt(las.count) * BigInt(las.length) : 0n, 235);
    header.writeUInt32LE(evlrs, 243);
  }
  return Buffer.concat([header, ...kept]);
}

function writePoints(out, las, { perf, decoder }) {
  const perBlock = Math.max(1, Math.floor(BLOCK / las.length));
  const place = perf._malloc(perBlock * las.length);
  if (place === 0) throw new Refusal('not enough memory for a block of points');
  for (let first = 0; first < las.count; first += perBlock) {
    const count = Math.min(perBlock, las.count - first);
    let i = 0;
    try {
      for (; i < count; ++i) decoder.getPoint(place + i * las.length);
    } catch (error) {
      throw new Refusal(`damaged at point ${first + i} of ${las.count}: ${reasonOf(error, perf)}`);
    }
    writeAll(out, Buffer.from(perf.HEAPU8.buffer, place, count * las.length));
  }
}

/** Where the extended records stand that mean something without the octree. */
function findExtended(file, size, las) {
  if (las.minor < 4) return [];
  const found = [];
  let at = Number(las.header.readBigUInt64LE(235));
  for (let left = las.header.readUInt32LE(243); left > 0; --left) {
    if (at + EVLR > size) throw new Refusal('truncated: the file ends inside its extended records');
    const head = readAt(file, at, EVLR);
    const length = EVLR + Number(head.readBigUInt64LE(20));
    if (at + length > size) throw new Refusal('truncated: the file ends inside its extended records');
    if (text(head, 2, 16) !== 'copc') found.push({ at, length });
    at += length;
  }
  return found;
}

function copy(file, out, { at, length }) {
  for (let done = 0; done < length; done += BLOCK)
    writeAll(out, readAt(file, at + done, Math.min(BLOCK, length - done)));
}

async function convert(input, output) {
  const { createLazPerf } = loadPackage();
  const file = fs.openSync(input, 'r');
  const size = fs.fstatSync(file).size;
  const las = readHead(file, size);
  const compression = readCompression(las);
  const extended = findExtended(file, size, las);
  checkCount(file, size, las, compression);
  const out = fs.openSync(`${output}.tmp`, 'w');
  try {
    const decoding = await openDecoder(file, size, las, createLazPerf);
    writeAll(out, plainHead(las, extended.length));
    writePoints(out, las, decoding);
    for (const record of extended) copy(file, out, record);
    // Not synced to disk: the file is mostly read once and removed, and can always be made again.
    fs.renameSync(`${output}.tmp`, output);
  } catch (error) {
    fs.rmSync(`${output}.tmp`, { force: true });
    if (error instanceof Refusal) error.message += ` (${compression.words})`;
    throw error;
  } finally {
    fs.closeSync(out);
  }
}

if (process.argv.length !== 4) {
  process.stderr.write('laz2las: usage: node laz2las.mjs IN.laz OUT.las\n');
  process.exit(2);
}
try {
  await convert(process.argv[2], process.argv[3]);
} catch (error) {
  process.stderr.write(`laz2las: ${String(error?.message ?? error).split('\n')[0]}\n`);
  process.exit(2);
}
