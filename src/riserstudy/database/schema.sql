-- The results database. Names and texts are those of study files, scenes and datasets; values are in SI
-- unless a table of units says otherwise. A value that is not a number, as where nothing was estimated, is null.

create table about (
    riserstudy text not null,     -- version that wrote this file
    builder text not null         -- digest of the code that did
);

create table papers (
    paper text primary key
);

create table files (              -- everything in the results folder that the database speaks of
    path text primary key,        -- within the folder
    kind text not null check (kind in ('dataset', 'figure', 'table')),
    bytes integer not null check (bytes >= 0),
    sha256 text not null check (length(sha256) = 64)
);

create table studies (            -- every dataset: simulated, derived from others, or measured on the engine
    study text primary key,       -- paper/name
    paper text not null references papers (paper),
    name text not null,
    kind text not null check (kind in ('simulated', 'hours', 'derived', 'measured')),
    caption text not null,
    axes text not null,           -- JSON: name and number of values
    rows integer not null check (rows >= 0),
    scene text,                   -- scene file
    tier text,
    accuracy text,                -- that was asked for, as written
    engine text,                  -- digest of the sources of the engine
    table_name text not null unique,  -- its wide table
    path text not null unique references files (path)
);

create table reads (              -- what a derived dataset is made from
    study text not null references studies (study) on delete cascade,
    source text not null references studies (study) on delete cascade,
    primary key (study, source)
) without rowid;

create table columns (            -- of the wide tables
    table_name text not null,
    column_name text not null,
    study text not null references studies (study) on delete cascade,
    role text not null check (role in ('row', 'axis', 'result', 'fact', 'assumed')),
    unit text,
    long_name text,
    position integer not null,
    primary key (table_name, column_name)
) without rowid;

create table effect_sets (        -- points with the same effects share a set
    effect_set integer not null,
    effect text not null,
    is_on integer not null check (is_on in (0, 1)),
    because text not null,
    primary key (effect_set, effect)
) without rowid;

create table points (             -- simulated points; a scene that two studies share is two points with one key
    point integer primary key,
    study text not null references studies (study) on delete cascade,
    position integer not null,    -- in the dataset, last axis fastest
    key text not null,            -- in the store
    place text not null,          -- on the axes, as text
    engine text not null,
    effect_set integer,
    -- facts of the run
    unique (study, position)
);

create table paths (
    path_id integer primary key,
    path text not null unique     -- in a scene
);

create table parameter_values (
    value_id integer primary key,
    path_id integer not null references paths (path_id),
    value real,                   -- SI; null where it is text
    unit text,
    as_written text not null,
    origin text not null check (origin in ('published', 'given', 'derived', 'assumed', 'calibrated', 'chosen', 'varied')),
    because text not null
);
create index parameter_values_by_path on parameter_values (path_id, value);

create table study_parameters (   -- the same at all points of a study
    study text not null references studies (study) on delete cascade,
    value_id integer not null references parameter_values (value_id),
    primary key (study, value_id)
) without rowid;

create table parameter_sets (     -- what an axis sets at one place on it; several axes where they set the same
    parameter_set integer not null,
    value_id integer not null references parameter_values (value_id),
    primary key (parameter_set, value_id)
) without rowid;

create table point_sets (         -- different between points of a study
    point integer not null references points (point) on delete cascade,
    parameter_set integer not null,
    primary key (point, parameter_set)
) without rowid;

create table quantities (
    quantity_id integer primary key,
    quantity text not null,
    statistic text not null check (statistic in
        ('value', 'max', 'min', 'amplitude', 'last', 'static', 'static_max', 'static_min', 'absmax')),
    unit text,
    long_name text,
    unique (quantity, statistic, unit)
);

create table result_values (
    point integer not null references points (point) on delete cascade,
    quantity_id integer not null references quantities (quantity_id),
    value real not null,
    s real,                       -- where, arclength from the bottom (m)
    time real,                    -- when (s)
    cylinder integer,             -- which one of the tensioners
    primary key (point, quantity_id)
) without rowid;

create table numbers_and_claims (
    paper text not null references papers (paper),
    id text not null,
    figure text not null,         -- of the paper
    kind text not null check (kind in ('number', 'claim')),
    statement text not null,
    published real,
    simulated real,
    unit text not null,
    error real,
    verdict text not null,
    share real check (share between 0 and 1),  -- of the samples that meet it
    share_low real check (share_low between 0 and 1),  -- its 95 % interval, where samples are many
    share_high real check (share_high between 0 and 1),
    met integer,
    samples integer,
    decided_by text not null,
    margin real,                  -- signed distance from where it would turn, -1 to 1
    margin_low real,              -- between these in nine of ten samples
    margin_high real,
    note text not null,
    grounds text not null,        -- JSON: what the verdict rests on
    primary key (paper, id)
);

create table margins (            -- of each case of a number or claim
    paper text not null references papers (paper),
    id text not null,
    place text not null,          -- JSON: sample and cell, by axis
    base integer not null check (base in (0, 1)),  -- the base case
    judged integer not null check (judged in (0, 1)),  -- counts in the share
    met integer check (met in (0, 1)),  -- null where nothing is found
    same integer not null check (same in (0, 1)),  -- not true because what it compares does not differ
    margin real,
    calibrated integer not null check (calibrated in (0, 1)),
    rests_on text not null,       -- JSON: axes by which place picks its points, by simulated study
    primary key (paper, id, place, base)
) without rowid;

create table rests_on (           -- datasets that a number or claim, or the simulation of an erratum, is checked with
    paper text not null references papers (paper),
    id text not null,
    study text not null references studies (study) on delete cascade,
    primary key (paper, id, study)
) without rowid;

create table errata (
    paper text not null references papers (paper),
    id text not null,
    "where" text not null,
    printed text not null,
    reading text not null,
    simulation text not null,
    primary key (paper, id)
);

create table figures (
    figure text primary key,      -- paper/name
    paper text not null references papers (paper),
    name text not null,
    caption text not null,
    png text not null references files (path),
    pdf text not null references files (path)
);

create table figure_reads (
    figure text not null references figures (figure) on delete cascade,
    study text not null references studies (study) on delete cascade,
    primary key (figure, study)
) without rowid;

create view parameters as
    select point, path, value, unit, as_written, origin, because
    from paths join parameter_values using (path_id) join study_parameters using (value_id)
         join points using (study)
    union all
    select point, path, value, unit, as_written, origin, because
    from paths join parameter_values using (path_id) join parameter_sets using (value_id)
         join point_sets using (parameter_set);

create view results as
    select point, quantity, statistic, value, unit, s, time, cylinder
    from quantities join result_values using (quantity_id);

create view effects as
    select point, effect, is_on, because from points join effect_sets using (effect_set);

create view simulated_behind as   -- simulated studies behind every dataset, itself where it is simulated
    with recursive behind (study, source) as (
        select study, study from studies
        union
        select behind.study, reads.source from behind join reads on reads.study = behind.source
    )
    select behind.study, source from behind join studies on studies.study = source where kind = 'simulated';

create view points_of_claims as   -- points that a number, a claim or an erratum rests on
    select distinct rests_on.paper, id, points.study, point
    from rests_on join simulated_behind using (study) join points on points.study = source;
