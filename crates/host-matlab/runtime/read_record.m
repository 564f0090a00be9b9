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
[found, messages] = find_records(bytes);
if isempty(found.begin_ns)
    error('sensedsl:format', '%s has no attachment schema.json: it is no record of a board', file);
end
[run, link] = sort_out(found, bytes, messages);
end

function [found, messages] = find_records(bytes)
% What a file has besides messages, and where these begin and end: a column each. A record that is not whole ends it.
found = struct('begin_ns', [], 'is_whole', false);
% By the number of a channel, one more than its identifier.
found.channels = {};
messages = zeros(2, 1024);
count = 0;
at = 9;
last = numel(bytes);
while at + 8 <= last
    size = double(typecast(bytes(at + 1:at + 8), 'uint64'));
    operation = bytes(at);
    at = at + 9;
    stop = at + size - 1;
    if stop > last
        break;
    end
    switch operation
        case 2 % the footer
            found.is_whole = true;
            break;
        case 4
            found = take_channel(found, bytes, at);
        case 5
            count = count + 1;
            if count > numel(messages) / 2
                messages(:, 2 * count) = 0;
            end
            messages(:, count) = [at; stop];
        case 6
            % Its records are its end: they are read as if they stood by themselves.
            [compression, at] = text(bytes, at + 28);
            if ~isempty(compression)
                error('sensedsl:format', 'a chunk is compressed (%s), as another program has left it', compression);
            end
            stop = at + 7;
        case 9
            name = text(bytes, at + 16);
            if strcmp(name, 'schema.json') && isempty(found.begin_ns)
                found.begin_ns = number(bytes, at, 'uint64');
            end
    end
    at = stop + 1;
end
messages = messages(:, 1:count);
end

function found = take_channel(found, bytes, at)
place = double(number(bytes, at, 'uint16')) + 1;
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
end

function [run, link] = sort_out(found, bytes, messages)
run = struct();
link = struct('begin', double(found.begin_ns) / 1e9, 'is_whole', found.is_whole);
starts = messages(1, :);
stops = messages(2, :);
places = double(bytes(starts)) + 256 * double(bytes(starts + 1)) + 1;
for place = 1:numel(found.channels)
    channel = found.channels{place};
    if isempty(channel) || ~strcmp(channel.encoding, 'json')
        continue;
    end
    slash = find(channel.topic == '/', 2);
    board = field(channel.topic(2:slash(2) - 1));
    name = channel.topic(slash(2) + 1:end);
    own = find(places == place);
    octets = bytes(bsxfun(@plus, starts(own), (6:13)'));
    times = typecast(reshape(octets, 1, []), 'uint64');
    % Of two whole numbers, so that no nanosecond is lost before the difference.
    t = double(times - found.begin_ns)' / 1e9;
    texts = lines_of(bytes, starts(own) + 22, stops(own));
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

function texts = lines_of(bytes, starts, stops)
% Parts of the file as lines of one text: to take them one by one would last much longer.
texts = '';
if isempty(starts)
    return;
end
lengths = stops - starts + 2;
steps = ones(1, sum(lengths));
steps(1) = starts(1);
ends = cumsum(lengths);
steps(ends(1:end - 1) + 1) = starts(2:end) - stops(1:end - 1) - 1;
bytes(end + 1) = 0;
texts = char(bytes(cumsum(steps)));
texts(ends) = char(10);
end

function messages = decoded(texts)
% A cell for each line.
if isempty(texts)
    messages = {};
    return;
end
messages = jsondecode(['[', strrep(texts(1:end - 1), char(10), ','), ']']);
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
all = numbers(texts, count, numel(t));
one = struct('t', t, 'value', all.value, 'raw', [], 'unit', channel.unit);
one.name = name;
one.type = channel.type;
one.direction = channel.direction;
switch kind
    case {'int64', 'uint64'}
        one.raw = whole_numbers(texts, count, kind);
    case 'bool'
        one.raw = all.raw ~= 0;
        one.value = one.value ~= 0;
    case 'float32'
        one.raw = single(all.raw);
    case 'float64'
        one.raw = all.raw;
    otherwise
        one.raw = feval(kind, all.raw);
end
if isfield(all, 'stamp_us')
    one.stamp_us = uint32(all.stamp_us);
    one.counter = uint8(all.counter);
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

function all = numbers(texts, count, rows)
% The fields of the messages of a device, a row for each message. They all look like the first one, which so says how
% they are read: that is much quicker than jsondecode, and exact to the last digit, which Octave's jsondecode is not.
% What is no number is null in the record, and NaN here.
all = struct('value', zeros(0, count), 'raw', zeros(0, count));
if rows == 0
    return;
end
texts = strrep(strrep(strrep(texts, 'null', 'NaN'), 'true', '1'), 'false', '0');
form = regexprep(texts(1:find(texts == char(10), 1) - 1), '([:,\[])(NaN|[-+.0-9eE]+)', '$1%f');
found = sscanf(texts, [form, ' ']);
names = regexp(form, '"(\w+)":', 'tokens');
width = numel(strfind(form, '%f'));
if numel(found) ~= width * rows
    error('sensedsl:format', 'a value cannot be read: the record is damaged');
end
found = reshape(found, width, rows)';
column = 0;
for i = 1:numel(names)
    name = names{i}{1};
    wide = 1;
    if any(strcmp(name, {'value', 'raw'}))
        wide = count;
    end
    all.(name) = found(:, column + (1:wide));
    column = column + wide;
end
end

function all = whole_numbers(texts, count, kind)
% 64 bits are more than a double has.
list = regexp(texts, '"raw":\[?([-0-9,]*)', 'tokens');
all = zeros(numel(list), count, kind);
for i = 1:numel(list)
    digits = strsplit(list{i}{1}, ',');
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
