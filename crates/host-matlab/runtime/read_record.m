function [run, link] = read_record(file)
% READ_RECORD  What a record of `sensedsl monitor --record` holds.
%
%   run = read_record('run.mcap')
%   plot(run.Rover.Light.t, run.Rover.Light.value)
%
% For each board a struct, and in it one for each of its devices:
%
%   t          seconds since the run began, a column
%   value      as it is shown, a row for each t; an array has a column for each element
%   raw        as it was sent, in the type of the design
%   unit       of value; '' for none
%   name, type, direction    as in the design
%   stamp_us, counter        by the board's clock, on links with stamps
%
% [run, link] = read_record(...) also gives for each board
%
%   link.Rover.health   how it was: a struct array with t, uptime_ms, devices and more
%   link.Rover.events   when it came and went: a struct array with t and event
%
% and link.begin, when the run began in seconds since 1970, and link.is_whole: false if whatever wrote the record was
% stopped. A name that cannot be a field has `_u` and a code for each byte that it cannot have, and `_`
% behind a keyword.
%
% Copied, not generated. For MATLAB from R2016b on and Octave from 7 on, without a toolbox.

if nargin < 1
    help read_record
    return;
end
from = fopen(file, 'r');
if from < 0
    error('sensedsl:open', '%s cannot be opened', file);
end
bytes = fread(from, Inf, '*uint8')';
fclose(from);
magic = uint8([137, double('MCAP0'), 13, 10]);
if numel(bytes) < 8 || any(bytes(1:8) ~= magic)
    error('sensedsl:format', '%s is no MCAP file', file);
end
found = empty_record();
[found, found.is_whole] = take_records(found, bytes, 9, numel(bytes));
if isempty(found.begin_ns)
    error('sensedsl:format', '%s has no attachment schema.json: it is no record of a board', file);
end
[run, link] = sort_out(found);
end

function found = empty_record()
found = struct('begin_ns', [], 'is_whole', false);
% By the number of a channel, one more than its identifier.
found.channels = {};
% By the same number: times, and texts.
found.times = {};
found.texts = {};
found.counts = [];
end

function [found, is_whole] = take_records(found, bytes, at, last)
% Takes the records of a file, or of a chunk. A record that is not whole ends it.
is_whole = false;
while at + 8 <= last
    operation = bytes(at);
    size = double(number(bytes, at + 1, 'uint64'));
    at = at + 9;
    stop = at + size - 1;
    if stop > last
        return;
    end
    switch operation
        case 2 % the footer
            is_whole = true;
            return;
        case 4
            found = take_channel(found, bytes, at);
        case 5
            found = take_message(found, bytes, at, stop);
        case 6
            found = take_chunk(found, bytes, at);
        case 9
            name = text(bytes, at + 16);
            if strcmp(name, 'schema.json') && isempty(found.begin_ns)
                found.begin_ns = number(bytes, at, 'uint64');
            end
    end
    at = stop + 1;
end
end

function found = take_chunk(found, bytes, at)
[compression, at] = text(bytes, at + 28);
if ~isempty(compression)
    error('sensedsl:format', 'a chunk is compressed (%s), as another program has left it', compression);
end
size = double(number(bytes, at, 'uint64'));
found = take_records(found, bytes, at + 8, at + 7 + size);
end

function found = take_channel(found, bytes, at)
place = double(number(bytes, at, 'uint16')) + 1;
if place <= numel(found.channels) && ~isempty(found.channels{place})
    return;
end
[topic, at] = text(bytes, at + 4);
[encoding, at] = text(bytes, at);
channel = struct('topic', topic, 'encoding', encoding, 'type', '', 'unit', '', 'direction', '');
stop = at + 3 + double(number(bytes, at, 'uint32'));
at = at + 4;
while at <= stop
    [key, at] = text(bytes, at);
    [about, at] = text(bytes, at);
    if isfield(channel, key)
        channel.(key) = about;
    end
end
found.channels{place} = channel;
found.times{place} = zeros(1, 64, 'uint64');
found.texts{place} = cell(1, 64);
found.counts(place) = 0;
end

function found = take_message(found, bytes, at, stop)
place = double(number(bytes, at, 'uint16')) + 1;
if place > numel(found.channels) || isempty(found.channels{place})
    return;
end
if ~strcmp(found.channels{place}.encoding, 'json')
    return;
end
count = found.counts(place) + 1;
found.counts(place) = count;
if count > numel(found.times{place})
    found.times{place}(2 * count) = 0;
    found.texts{place}{2 * count} = [];
end
found.times{place}(count) = number(bytes, at + 6, 'uint64');
found.texts{place}{count} = char(bytes(at + 22:stop));
end

function [run, link] = sort_out(found)
run = struct();
link = struct('begin', double(found.begin_ns) / 1e9, 'is_whole', found.is_whole);
for place = 1:numel(found.channels)
    channel = found.channels{place};
    if isempty(channel) || ~strcmp(channel.encoding, 'json')
        continue;
    end
    slash = find(channel.topic == '/', 2);
    board = field(channel.topic(2:slash(2) - 1));
    name = channel.topic(slash(2) + 1:end);
    count = found.counts(place);
    % Of two whole numbers, so that no nanosecond is lost before the difference.
    t = double(found.times{place}(1:count) - found.begin_ns)' / 1e9;
    texts = found.texts{place}(1:count);
    if strcmp(name, 'link/health') || strcmp(name, 'link/events')
        link.(board).(name(6:end)) = with_times(decoded(texts), t);
    elseif ~isempty(channel.type)
        key = field(name);
        while isfield(run, board) && isfield(run.(board), key)
            key = [key, '_']; %#ok<AGROW>
        end
        run.(board).(key) = device(channel, name, t, texts);
    end
end
end

function messages = decoded(texts)
% A cell for each text.
if isempty(texts)
    messages = {};
    return;
end
messages = jsondecode(['[', strjoin(texts, ','), ']']);
if ~iscell(messages)
    messages = num2cell(messages);
end
end

function list = with_times(messages, t)
names = {};
for i = 1:numel(messages)
    names = union(names, fieldnames(messages{i}));
end
list = struct('t', num2cell(t));
for n = 1:numel(names)
    for i = 1:numel(messages)
        if isfield(messages{i}, names{n})
            list(i).(names{n}) = messages{i}.(names{n});
        else
            list(i).(names{n}) = [];
        end
    end
end
end

function one = device(channel, name, t, texts)
[kind, count] = parts(channel.type);
one = struct('t', t, 'value', numbers(texts, 'value', count), 'raw', [], 'unit', channel.unit);
one.name = name;
one.type = channel.type;
one.direction = channel.direction;
switch kind
    case {'int64', 'uint64'}
        one.raw = whole_numbers(texts, count, kind);
    case 'bool'
        one.raw = numbers(texts, 'raw', count) ~= 0;
        one.value = one.value ~= 0;
    case 'float32'
        one.raw = single(numbers(texts, 'raw', count));
    case 'float64'
        one.raw = numbers(texts, 'raw', count);
    otherwise
        one.raw = feval(kind, numbers(texts, 'raw', count));
end
if ~isempty(texts) && ~isempty(strfind(texts{1}, '"stamp_us":'))
    one.stamp_us = uint32(numbers(texts, 'stamp_us', 1));
    one.counter = uint8(numbers(texts, 'counter', 1));
end
end

function [kind, count] = parts(type)
% 'uint16[3]': its word, and its elements.
bracket = find(type == '[', 1);
if isempty(bracket)
    kind = type;
    count = 1;
else
    kind = type(1:bracket - 1);
    count = str2double(type(bracket + 1:end - 1));
end
end

function list = cells(texts, name)
% The text of a field in each message, without brackets: `1,2,3`.
found = regexp(texts, ['"', name, '":\[?([^\]}"]*)'], 'tokens', 'once');
list = cellfun(@(one) one{1}, found, 'UniformOutput', false);
end

function all = numbers(texts, name, count)
% A row for each message. Not by jsondecode, which is not exact to the last digit in Octave. What is no number is null
% in the record, and NaN here.
list = strrep(strrep(strrep(cells(texts, name), 'null', 'NaN'), 'true', '1'), 'false', '0');
all = sscanf(strrep(strjoin(list, ' '), ',', ' '), '%f');
all = reshape(all, count, numel(texts))';
end

function all = whole_numbers(texts, count, kind)
% 64 bits are more than a double has.
all = zeros(numel(texts), count, kind);
list = cells(texts, 'raw');
for i = 1:numel(texts)
    digits = strsplit(list{i}, ',');
    for k = 1:count
        is_negative = digits{k}(1) == '-';
        element = zeros(1, 1, kind);
        for digit = digits{k}(1 + is_negative:end) - '0'
            if is_negative
                element = element * 10 - digit;
            else
                element = element * 10 + digit;
            end
        end
        all(i, k) = element;
    end
end
end

function value = number(bytes, at, kind)
% Little end first, as in the file; so are all processors that MATLAB runs on.
switch kind
    case 'uint16'
        count = 2;
    case 'uint32'
        count = 4;
    otherwise
        count = 8;
end
value = typecast(bytes(at:at + count - 1), kind);
end

function [value, next] = text(bytes, at)
count = double(number(bytes, at, 'uint32'));
value = char(bytes(at + 4:at + 3 + count));
if any(bytes(at + 4:at + 3 + count) > 127)
    value = native2unicode(bytes(at + 4:at + 3 + count), 'UTF-8');
end
next = at + 4 + count;
end

function name = field(name)
% A name that can be a field.
keywords = {'break', 'case', 'catch', 'classdef', 'continue', 'do', 'else', 'elseif', 'end', 'for', 'function', ...
    'global', 'if', 'otherwise', 'parfor', 'persistent', 'return', 'spmd', 'switch', 'try', 'until', 'while'};
if any(strcmp(name, keywords))
    name = [name, '_'];
    return;
end
letters = ['A':'Z', 'a':'z'];
plain = '';
for byte = unicode2native(name, 'UTF-8')
    if any(byte == [letters, '0':'9', '_'])
        plain = [plain, char(byte)]; %#ok<AGROW>
    else
        plain = [plain, sprintf('_u%x', byte)]; %#ok<AGROW>
    end
end
if ~any(plain(1) == letters)
    plain = ['n', plain];
end
name = plain;
end
